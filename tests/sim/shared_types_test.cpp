// SPDX-License-Identifier: Apache-2.0
// The structures that C++ and GLSL share: a shader is asked, through reflection, where it puts each member.
#include <epoxy/gl.h>

#include <cstddef>
#include <map>

#include "base/motion_settings.h"
#include "shaders/shared/simulation_types.h"
#include "sim/gl/program.h"
#include "tests/sim/gpu_test.h"

namespace throng::test {
namespace {

class SharedTypesTest : public GpuTest {
  protected:
    /// Offsets by member name, e.g. "people[0].radius", of one interface of a program.
    std::map<std::string, GLint> offsets(const gl::Program& program, GLenum interface) {
        std::map<std::string, GLint> result;
        GLint count = 0;
        glGetProgramInterfaceiv(program.handle(), interface, GL_ACTIVE_RESOURCES, &count);
        for (GLint i = 0; i < count; ++i) {
            char name[256] = {};
            const GLenum property = GL_OFFSET;
            const GLenum stride_property = GL_TOP_LEVEL_ARRAY_STRIDE;
            GLint offset = -1;
            GLint stride = 0;
            glGetProgramResourceName(program.handle(), interface, static_cast<GLuint>(i), sizeof name,
                                     nullptr, name);
            glGetProgramResourceiv(program.handle(), interface, static_cast<GLuint>(i), 1, &property, 1,
                                   nullptr, &offset);
            if (interface == GL_BUFFER_VARIABLE) {
                glGetProgramResourceiv(program.handle(), interface, static_cast<GLuint>(i), 1,
                                       &stride_property, 1, nullptr, &stride);
                strides_[name] = stride;
            }
            result[name] = offset;
        }
        return result;
    }
    void expectOffset(const std::map<std::string, GLint>& found, const std::string& name, std::size_t offset,
                      std::size_t stride) {
        const auto entry = found.find(name);
        ASSERT_NE(entry, found.end()) << name;
        EXPECT_EQ(static_cast<std::size_t>(entry->second), offset) << name;
        if (stride) {
            EXPECT_EQ(static_cast<std::size_t>(strides_.at(name)), stride) << name;
        }
    }

    std::map<std::string, GLint> strides_;
};

#define EXPECT_MEMBER(found, block, type, member) \
    expectOffset(found, block "[0]." #member, offsetof(gpu::type, member), sizeof(gpu::type))

TEST_F(SharedTypesTest, PersonAndStateAgree) {
    const gl::Program move(library, everythingIn("shaders/motion/move.comp"));
    const auto found = offsets(move, GL_BUFFER_VARIABLE);
    EXPECT_MEMBER(found, "people", Person, spawn_position);
    EXPECT_MEMBER(found, "people", Person, radius);
    EXPECT_MEMBER(found, "people", Person, preferred_speed);
    EXPECT_MEMBER(found, "people", Person, maximum_speed);
    EXPECT_MEMBER(found, "people", Person, entry);
    EXPECT_MEMBER(found, "people", Person, flags);
    EXPECT_MEMBER(found, "people", Person, first_stage);
    EXPECT_MEMBER(found, "people", Person, stage_count);
    EXPECT_MEMBER(found, "people", Person, headway);
    EXPECT_MEMBER(found, "states", AgentState, position);
    EXPECT_MEMBER(found, "states", AgentState, velocity);
    EXPECT_MEMBER(found, "states", AgentState, heading);
    EXPECT_MEMBER(found, "states", AgentState, status);
    EXPECT_MEMBER(found, "states", AgentState, spawn_step);
    EXPECT_MEMBER(found, "states", AgentState, attempts);
    EXPECT_MEMBER(found, "states", AgentState, nervousness);
    EXPECT_MEMBER(found, "bodies", Body, position);
    EXPECT_MEMBER(found, "bodies", Body, radius);
    EXPECT_MEMBER(found, "bodies", Body, row);
    EXPECT_MEMBER(found, "bodies", Body, maximum_speed);
    EXPECT_MEMBER(found, "walkers", Walker, preferred_speed);
    EXPECT_MEMBER(found, "walkers", Walker, flags);
    EXPECT_MEMBER(found, "walkers", Walker, party_size);
    EXPECT_MEMBER(found, "walkers", Walker, change_count);
    EXPECT_MEMBER(found, "walkers", Walker, stage);
    EXPECT_MEMBER(found, "walkers", Walker, ticket);
    EXPECT_MEMBER(found, "walkers", Walker, nervousness);
    EXPECT_MEMBER(found, "stages", Stage, point);
    EXPECT_MEMBER(found, "stages", Stage, tolerance);
    EXPECT_MEMBER(found, "stages", Stage, field);
    EXPECT_MEMBER(found, "stages", Stage, dwell);
    EXPECT_MEMBER(found, "stages", Stage, facing);
    EXPECT_MEMBER(found, "stages", Stage, line);
    EXPECT_MEMBER(found, "stages", Stage, flags);
    EXPECT_MEMBER(found, "states", AgentState, stage_end);
    EXPECT_MEMBER(found, "states", AgentState, ticket);
    EXPECT_MEMBER(found, "plan_changes", PlanChange, start_step);
    EXPECT_MEMBER(found, "plan_changes", PlanChange, stage_count);
    EXPECT_MEMBER(found, "waiting_lines", WaitingLine, spacing);
    EXPECT_MEMBER(found, "waiting_lines", WaitingLine, candidate);
}

TEST_F(SharedTypesTest, WallsSitesAndQueuesAgree) {
    const gl::Program sense(library, everythingIn("shaders/sensing/sense.comp"),
                            {{"NEIGHBOURS", "4"}, {"SENSING_SAMPLES", "4"}});
    const auto sensed = offsets(sense, GL_BUFFER_VARIABLE);
    EXPECT_MEMBER(sensed, "wall_tiles", WallTile, position);
    EXPECT_MEMBER(sensed, "wall_tiles", WallTile, tile_radius);
    EXPECT_MEMBER(sensed, "wall_tiles", WallTile, segment);
    EXPECT_MEMBER(sensed, "wall_segments", WallSegment, a);
    EXPECT_MEMBER(sensed, "wall_segments", WallSegment, b);
    EXPECT_MEMBER(sensed, "wall_segments", WallSegment, half_thickness);
    EXPECT_MEMBER(sensed, "wall_segments", WallSegment, wall);
    const gl::Program propose(library, everythingIn("shaders/motion/spawn_propose.comp"));
    const auto proposed = offsets(propose, GL_BUFFER_VARIABLE);
    EXPECT_MEMBER(proposed, "queues", SpawnQueue, first_row);
    EXPECT_MEMBER(proposed, "queues", SpawnQueue, row_count);
    EXPECT_MEMBER(proposed, "entries", Entry, first_point);
    EXPECT_MEMBER(proposed, "entries", Entry, point_count);
    EXPECT_MEMBER(proposed, "proposals", SpawnProposal, position);
    EXPECT_MEMBER(proposed, "proposals", SpawnProposal, radius);
    EXPECT_MEMBER(proposed, "proposals", SpawnProposal, row);
    const gl::Program splat(library, everythingIn("shaders/diagram/site.comp"));
    const auto splatted = offsets(splat, GL_BUFFER_VARIABLE);
    EXPECT_MEMBER(splatted, "sites", DiagramSite, position);
    EXPECT_MEMBER(splatted, "sites", DiagramSite, radius);
    EXPECT_MEMBER(splatted, "sites", DiagramSite, id);
}

TEST_F(SharedTypesTest, ParametersAgree) {
    const gl::Program avoid(library, everythingIn("shaders/motion/avoid.comp"), {{"NEIGHBOURS", "4"}});
    const auto found = offsets(avoid, GL_UNIFORM);
    const auto expectParameter = [&](const std::string& member, std::size_t offset) {
        const std::string suffix = "." + member;
        for (const auto& [name, at] : found) {
            if (!name.ends_with(suffix)) continue;
            EXPECT_EQ(static_cast<std::size_t>(at), offset) << name;
            return;
        }
        ADD_FAILURE() << "no parameter " << member;
    };
#define EXPECT_PARAMETER(member) expectParameter(#member, offsetof(gpu::Parameters, member))
    EXPECT_PARAMETER(cells_minimum);
    EXPECT_PARAMETER(cell_size);
    EXPECT_PARAMETER(row_count);
    EXPECT_PARAMETER(diagram_minimum);
    EXPECT_PARAMETER(pixels_per_metre);
    EXPECT_PARAMETER(step_seconds);
    EXPECT_PARAMETER(contact_range);
    EXPECT_PARAMETER(contact_slack);
    EXPECT_PARAMETER(maximum_acceleration);
    EXPECT_PARAMETER(grid_minimum);
    EXPECT_PARAMETER(grid_cell);
    EXPECT_PARAMETER(has_roads);
}

}  // namespace
}  // namespace throng::test
