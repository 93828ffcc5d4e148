// SPDX-License-Identifier: Apache-2.0
// The structures that C++ and GLSL share: every one in the headers has its members where both compilers say
// they are.
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <regex>
#include <set>

#include "shaders/shared/behaviour_types.h"
#include "shaders/shared/boarding_types.h"
#include "shaders/shared/chart_types.h"
#include "shaders/shared/lift_types.h"
#include "shaders/shared/seat_types.h"
#include "shaders/shared/simulation_types.h"
#include "shaders/shared/terrain_types.h"
#include "shaders/shared/traffic_types.h"
#include "sim/gl/embedded_shaders.h"
#include "tests/sim/gpu_test.h"

namespace throng::test {
namespace {

/// A structure as one of the two compilers lays it out.
struct Layout {
    std::size_t stride;
    std::vector<std::pair<std::string, std::size_t>> members;  // and their offsets, in order
    bool operator==(const Layout&) const = default;
};

void PrintTo(const Layout& layout, std::ostream* out) {
    for (const auto& [member, offset] : layout.members)
        *out << member << " at " << offset << ", ";
    *out << "every " << layout.stride << " bytes";
}

#define MEMBER(name) \
    { #name, offsetof(T, name) }

/// What the C++ compiler says. Whoever adds a structure or a member adds it here: the test misses it
/// otherwise.
std::map<std::string, Layout> layoutsInCpp() {
    std::map<std::string, Layout> result;
    {
        using T = gpu::Person;
        result["Person"] = {sizeof(T), {MEMBER(spawn_position), MEMBER(radius),       MEMBER(preferred_speed),
                                        MEMBER(maximum_speed),  MEMBER(spawn_time),   MEMBER(heading),
                                        MEMBER(phase),          MEMBER(variation),    MEMBER(entry),
                                        MEMBER(flags),          MEMBER(first_stage),  MEMBER(stage_count),
                                        MEMBER(first_change),   MEMBER(change_count), MEMBER(party_first),
                                        MEMBER(party_size),     MEMBER(group),        MEMBER(headway),
                                        MEMBER(kind),           MEMBER(half_axis),    MEMBER(own_radius)}};
    }
    {
        using T = gpu::Stage;
        result["Stage"] = {sizeof(T),
                           {MEMBER(point), MEMBER(facing), MEMBER(tolerance), MEMBER(field), MEMBER(dwell),
                            MEMBER(line), MEMBER(activity), MEMBER(flags), MEMBER(beyond), MEMBER(board)}};
    }
    {
        using T = gpu::Drawn;
        result["Drawn"] = {sizeof(T),
                           {MEMBER(kind), MEMBER(mean), MEMBER(deviation), MEMBER(minimum), MEMBER(maximum)}};
    }
    {
        using T = gpu::BehaviourState;
        result["BehaviourState"] = {sizeof(T),
                                    {MEMBER(facing),
                                     MEMBER(from),
                                     MEMBER(does),
                                     MEMBER(flags),
                                     MEMBER(first_rule),
                                     MEMBER(rule_count),
                                     MEMBER(then),
                                     MEMBER(first_place),
                                     MEMBER(place_count),
                                     MEMBER(activity),
                                     MEMBER(least),
                                     MEMBER(most),
                                     MEMBER(first_row),
                                     MEMBER(row_count),
                                     MEMBER(distance),
                                     MEMBER(pace),
                                     MEMBER(lasts.kind),
                                     MEMBER(lasts.mean),
                                     MEMBER(lasts.deviation),
                                     MEMBER(lasts.minimum),
                                     MEMBER(lasts.maximum),
                                     MEMBER(line)}};
    }
    {
        using T = gpu::BehaviourPlace;
        result["BehaviourPlace"] = {
            sizeof(T),
            {MEMBER(middle), MEMBER(facing), MEMBER(field), MEMBER(first_point), MEMBER(point_count),
             MEMBER(first_corner), MEMBER(corner_count), MEMBER(weight)}};
    }
    {
        using T = gpu::BehaviourRule;
        result["BehaviourRule"] = {
            sizeof(T),
            {MEMBER(condition), MEMBER(then), MEMBER(subject), MEMBER(first), MEMBER(count), MEMBER(number),
             MEMBER(time.kind), MEMBER(time.mean), MEMBER(time.deviation), MEMBER(time.minimum),
             MEMBER(time.maximum), MEMBER(reserved)}};
    }
    {
        using T = gpu::Census;
        result["Census"] = {
            sizeof(T), {MEMBER(first_corner), MEMBER(corner_count), MEMBER(first_row), MEMBER(row_count)}};
    }
    {
        using T = gpu::Tally;
        result["Tally"] = {sizeof(T), {MEMBER(present), MEMBER(inside)}};
    }
    {
        using T = gpu::SeatWay;
        result["SeatWay"] = {sizeof(T),
                             {MEMBER(place), MEMBER(stand), MEMBER(shift), MEMBER(height), MEMBER(heading),
                              MEMBER(length), MEMBER(mouth), MEMBER(aside), MEMBER(fork), MEMBER(row),
                              MEMBER(first_point), MEMBER(point_count), MEMBER(lane), MEMBER(branch),
                              MEMBER(free_side), MEMBER(first_of_aisle), MEMBER(count_of_aisle)}};
    }
    {
        using T = gpu::SeatLane;
        result["SeatLane"] = {sizeof(T), {MEMBER(first), MEMBER(count)}};
    }
    {
        using T = gpu::AisleWalker;
        result["AisleWalker"] = {sizeof(T),
                                 {MEMBER(number), MEMBER(mode), MEMBER(side), MEMBER(since), MEMBER(along),
                                  MEMBER(share), MEMBER(mouth), MEMBER(lane_and_branch)}};
    }
    {
        using T = gpu::SeatPoint;
        result["SeatPoint"] = {sizeof(T),
                               {MEMBER(place), MEMBER(beside), MEMBER(alone), MEMBER(height), MEMBER(along)}};
    }
    {
        using T = gpu::Sitter;
        result["Sitter"] = {sizeof(T),
                            {MEMBER(off), MEMBER(along), MEMBER(speed), MEMBER(share), MEMBER(mode),
                             MEMBER(since), MEMBER(activity), MEMBER(seated), MEMBER(side)}};
    }
    {
        using T = gpu::Mind;
        result["Mind"] = {
            sizeof(T),
            {MEMBER(state), MEMBER(since), MEMBER(entered), MEMBER(visited), MEMBER(visits_left),
             MEMBER(place), MEMBER(picks), MEMBER(flags), MEMBER(first_stage), MEMBER(followed),
             MEMBER(let_go), MEMBER(next), MEMBER(seat)}};
    }
    {
        using T = gpu::PlanChange;
        result["PlanChange"] = {
            sizeof(T), {MEMBER(start_step), MEMBER(first_stage), MEMBER(stage_count), MEMBER(reserved)}};
    }
    {
        using T = gpu::WaitingLine;
        result["WaitingLine"] = {
            sizeof(T),
            {MEMBER(first_point), MEMBER(point_count), MEMBER(first_ticket), MEMBER(ticket_count),
             MEMBER(spacing), MEMBER(given), MEMBER(served), MEMBER(candidate)}};
    }
    {
        using T = gpu::Entry;
        result["Entry"] = {sizeof(T), {MEMBER(first_point), MEMBER(point_count)}};
    }
    {
        using T = gpu::SpawnQueue;
        result["SpawnQueue"] = {sizeof(T), {MEMBER(first_row), MEMBER(row_count)}};
    }
    {
        using T = gpu::WallSegment;
        result["WallSegment"] = {sizeof(T), {MEMBER(a), MEMBER(b), MEMBER(half_thickness), MEMBER(wall)}};
    }
    {
        using T = gpu::Patch;
        result["Patch"] = {sizeof(T),
                           {MEMBER(lower), MEMBER(upper), MEMBER(pace), MEMBER(from), MEMBER(until),
                            MEMBER(first_point), MEMBER(point_count), MEMBER(size)}};
    }
    {
        using T = gpu::GivenWay;
        result["GivenWay"] = {sizeof(T), {MEMBER(first_place), MEMBER(place_count), MEMBER(shift)}};
    }
    {
        using T = gpu::GivenPlace;
        result["GivenPlace"] = {sizeof(T), {MEMBER(position), MEMBER(time), MEMBER(reserved)}};
    }
    {
        using T = gpu::WallTile;
        result["WallTile"] = {sizeof(T), {MEMBER(position), MEMBER(tile_radius), MEMBER(segment)}};
    }
    {
        using T = gpu::FieldCell;
        result["FieldCell"] = {sizeof(T), {MEMBER(distance), MEMBER(direction)}};
    }
    {
        using T = gpu::GroundCell;
        result["GroundCell"] = {sizeof(T),
                                {MEMBER(cost), MEMBER(one_way), MEMBER(open_sides), MEMBER(free_share)}};
    }
    {
        using T = gpu::AgentState;
        result["AgentState"] = {
            sizeof(T),
            {MEMBER(position), MEMBER(velocity), MEMBER(heading), MEMBER(walked), MEMBER(status),
             MEMBER(stage), MEMBER(stage_end), MEMBER(changes), MEMBER(leave_step), MEMBER(ticket),
             MEMBER(spawn_step), MEMBER(arrival_step), MEMBER(attempts), MEMBER(nervousness),
             MEMBER(shortest_way), MEMBER(walked_rest), MEMBER(rest)}};
    }
    {
        using T = gpu::Body;
        result["Body"] = {sizeof(T),
                          {MEMBER(position), MEMBER(velocity), MEMBER(radius), MEMBER(heading), MEMBER(row),
                           MEMBER(maximum_speed)}};
    }
    {
        using T = gpu::Walker;
        result["Walker"] = {
            sizeof(T),
            {MEMBER(preferred_speed), MEMBER(flags), MEMBER(status), MEMBER(stage), MEMBER(stage_end),
             MEMBER(leave_step), MEMBER(nervousness), MEMBER(way_through)}};
    }
    {
        using T = gpu::Chest;
        result["Chest"] = {sizeof(T),
                           {MEMBER(angle), MEMBER(rate), MEMBER(half_axis), MEMBER(own_half_axis)}};
    }
    {
        using T = gpu::Decision;
        result["Decision"] = {sizeof(T), {MEMBER(change), MEMBER(pace), MEMBER(feet)}};
    }
    {
        using T = gpu::DiagramSite;
        result["DiagramSite"] = {sizeof(T), {MEMBER(position), MEMBER(radius), MEMBER(id)}};
    }
    {
        using T = gpu::Band;
        result["Band"] = {
            sizeof(T),
            {MEMBER(groups_x), MEMBER(groups_y), MEMBER(groups_z), MEMBER(first_slot), MEMBER(end_slot)}};
    }
    {
        using T = gpu::SpawnProposal;
        result["SpawnProposal"] = {sizeof(T), {MEMBER(position), MEMBER(radius), MEMBER(row)}};
    }
    {
        using T = gpu::CrowdFlow;
        result["CrowdFlow"] = {sizeof(T), {MEMBER(velocity), MEMBER(density), MEMBER(reserved)}};
    }
    {
        using T = gpu::FieldMap;
        result["FieldMap"] = {sizeof(T), {MEMBER(ground_map), MEMBER(has_choice)}};
    }
    {
        using T = gpu::ChartCell;
        result["ChartCell"] = {sizeof(T), {MEMBER(charts), MEMBER(images)}};
    }
    {
        using T = gpu::LiftStop;
        result["LiftStop"] = {
            sizeof(T),
            {MEMBER(begin), MEMBER(along), MEMBER(chart), MEMBER(landing), MEMBER(height), MEMBER(lift)}};
    }
    {
        using T = gpu::LiftPlan;
        result["LiftPlan"] = {
            sizeof(T),
            {MEMBER(corner), MEMBER(across), MEMBER(forward), MEMBER(first_stop), MEMBER(stop_count),
             MEMBER(capacity), MEMBER(columns), MEMBER(half_door), MEMBER(half_width), MEMBER(depth),
             MEMBER(speed), MEMBER(door_time), MEMBER(dwell)}};
    }
    {
        using T = gpu::LiftState;
        result["LiftState"] = {
            sizeof(T),
            {MEMBER(height), MEMBER(open), MEMBER(stop), MEMBER(phase), MEMBER(since), MEMBER(idle),
             MEMBER(from), MEMBER(heading), MEMBER(aboard), MEMBER(given_up)}};
    }
    {
        using T = gpu::LiftWishes;
        result["LiftWishes"] = {
            sizeof(T),
            {MEMBER(up), MEMBER(down), MEMBER(goals), MEMBER(spots), MEMBER(aboard), MEMBER(leaving),
             MEMBER(boarding), MEMBER(in_doors), MEMBER(first), MEMBER(entering)}};
    }
    {
        using T = gpu::Belt;
        result["Belt"] = {sizeof(T),
                          {MEMBER(velocity), MEMBER(begin), MEMBER(along), MEMBER(length), MEMBER(half_width),
                           MEMBER(lane), MEMBER(stand), MEMBER(walking), MEMBER(has_steps)}};
    }
    {
        using T = gpu::SlotImage;
        result["SlotImage"] = {sizeof(T), {MEMBER(shift), MEMBER(person), MEMBER(reserved)}};
    }
    {
        using T = gpu::TerrainNode;
        result["TerrainNode"] = {sizeof(T), {MEMBER(height), MEMBER(steps)}};
    }
    {
        using T = gpu::Vehicle;
        result["Vehicle"] = {
            sizeof(T),
            {MEMBER(along), MEMBER(speed), MEMBER(acceleration), MEMBER(stand_until), MEMBER(status),
             MEMBER(next_stop), MEMBER(lane), MEMBER(kind), MEMBER(start), MEMBER(length), MEMBER(half_width),
             MEMBER(wished_speed), MEMBER(headway), MEMBER(most_acceleration), MEMBER(braking), MEMBER(gap)}};
    }
    {
        using T = gpu::VehicleBox;
        result["VehicleBox"] = {
            sizeof(T), {MEMBER(rear), MEMBER(front), MEMBER(ahead), MEMBER(half_width), MEMBER(speed)}};
    }
    {
        using T = gpu::TrafficLane;
        result["TrafficLane"] = {sizeof(T),
                                 {MEMBER(first_point), MEMBER(point_count), MEMBER(first_stop),
                                  MEMBER(stop_count), MEMBER(length), MEMBER(reserved)}};
    }
    {
        using T = gpu::LanePoint;
        result["LanePoint"] = {sizeof(T), {MEMBER(place), MEMBER(along), MEMBER(reserved)}};
    }
    {
        using T = gpu::TrafficStop;
        result["TrafficStop"] = {
            sizeof(T), {MEMBER(along), MEMBER(seconds), MEMBER(kind), MEMBER(light), MEMBER(crossing)}};
    }
    {
        using T = gpu::TrafficCrossing;
        result["TrafficCrossing"] = {
            sizeof(T), {MEMBER(first_point), MEMBER(point_count), MEMBER(light), MEMBER(entries)}};
    }
    {
        using T = gpu::VehicleDoor;
        result["VehicleDoor"] = {sizeof(T),
                                 {MEMBER(behind), MEMBER(half_width), MEMBER(sides), MEMBER(reserved)}};
    }
    {
        using T = gpu::DoorState;
        result["DoorState"] = {sizeof(T), {MEMBER(next), MEMBER(waiting)}};
    }
    {
        using T = gpu::VehicleService;
        result["VehicleService"] = {
            sizeof(T),
            {MEMBER(first_door), MEMBER(door_count), MEMBER(first_call), MEMBER(call_count), MEMBER(line),
             MEMBER(capacity), MEMBER(door_time), MEMBER(door_flow), MEMBER(phase), MEMBER(platform),
             MEMBER(open), MEMBER(since), MEMBER(stood), MEMBER(aboard), MEMBER(boarded), MEMBER(alighted)}};
    }
    {
        using T = gpu::Platform;
        result["Platform"] = {
            sizeof(T), {MEMBER(side), MEMBER(least), MEMBER(most), MEMBER(first_point), MEMBER(point_count)}};
    }
    {
        using T = gpu::AlightingCall;
        result["AlightingCall"] = {sizeof(T), {MEMBER(platform), MEMBER(first_row), MEMBER(row_count)}};
    }
    {
        using T = gpu::DoorWishes;
        result["DoorWishes"] = {sizeof(T),
                                {MEMBER(coming_out), MEMBER(going_in), MEMBER(in_door), MEMBER(waiting),
                                 MEMBER(first), MEMBER(deepest)}};
    }
    {
        using T = gpu::Parameters;
        result["Parameters"] = {sizeof(T), {MEMBER(cells_minimum),    MEMBER(diagram_minimum),
                                            MEMBER(grid_minimum),     MEMBER(cell_size),
                                            MEMBER(cells_width),      MEMBER(cells_height),
                                            MEMBER(pixels_per_metre), MEMBER(diagram_width),
                                            MEMBER(diagram_height),   MEMBER(grid_cell),
                                            MEMBER(grid_width),       MEMBER(grid_height),
                                            MEMBER(field_cell),       MEMBER(field_blocks_across),
                                            MEMBER(field_blocks_up),  MEMBER(cells_per_field),
                                            MEMBER(detour_cell),      MEMBER(detour_width),
                                            MEMBER(detour_height),    MEMBER(row_count),
                                            MEMBER(queue_count),      MEMBER(seed),
                                            MEMBER(tile_radius),      MEMBER(largest_radius),
                                            MEMBER(step_seconds),     MEMBER(decision_seconds),
                                            MEMBER(time_horizon),     MEMBER(wall_time_horizon),
                                            MEMBER(contact_range),    MEMBER(contact_gain),
                                            MEMBER(contact_push),     MEMBER(maximum_acceleration),
                                            MEMBER(site_rows),        MEMBER(chart_cell),
                                            MEMBER(chart_width),      MEMBER(chart_height)}};
    }
    return result;
}

/// The structures of the headers, and the header of each.
std::map<std::string, std::string> structuresOfHeaders() {
    static const std::regex structure(R"(\bstruct\s+(\w+))");
    std::map<std::string, std::string> result;
    for (const gl::EmbeddedShader& header : gl::embeddedShaders()) {
        if (!header.path.starts_with("shaders/shared/")) continue;
        const std::string text(header.text);
        for (std::sregex_iterator found(text.begin(), text.end(), structure), end; found != end; ++found)
            result[(*found)[1]] = header.path;
    }
    return result;
}

/// What a struct is laid out by: everything in storage buffers, and the parameters, belts and boxes of
/// vehicles as uniforms.
bool isUniform(const std::string& structure) {
    return structure == "Parameters" || structure == "Belt" || structure == "VehicleBox";
}

/// In a uniform block, what an array's items are laid out by.
static_assert(sizeof(gpu::Belt) % 16 == 0);

class SharedTypesTest : public GpuTest {
  protected:
    /// A program that does nothing but have a block of that structure.
    GLuint probe(const std::string& structure, const std::string& header) {
        std::vector<std::string> files;
        const std::string source =
            library.load(header, {}, files) + "layout(local_size_x = 1) in;\n" +
            (isUniform(structure) ? fmt::format("layout(std140) uniform Block {{ {0} item; }};\n"
                                                "layout(std430) buffer Copies {{ {0} copies[]; }};\n"
                                                "void main() {{ copies[0] = item; }}\n",
                                                structure)
                                  : fmt::format("layout(std430) buffer Block {{ {} item[]; }};\nvoid main() "
                                                "{{ item[0] = item[1]; }}\n",
                                                structure));
        const char* text = source.c_str();
        const GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &text);
        GLint linked = 0;
        glGetProgramiv(program, GL_LINK_STATUS, &linked);
        char log[4096] = {};
        if (!linked) glGetProgramInfoLog(program, sizeof log, nullptr, log);
        EXPECT_TRUE(linked) << structure << ": " << log;
        return program;
    }
    /// What the GLSL compiler says: all members of a block with such a layout are there, used or not.
    Layout reflect(GLuint program, const std::string& structure) {
        const GLenum interface = isUniform(structure) ? GL_UNIFORM : GL_BUFFER_VARIABLE;
        const std::string prefix = isUniform(structure) ? "item." : "item[0].";
        Layout result{};
        GLint count = 0;
        glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &count);
        for (GLint i = 0; i < count; ++i) {
            char name[256] = {};
            const auto index = static_cast<GLuint>(i);
            glGetProgramResourceName(program, interface, index, sizeof name, nullptr, name);
            if (!std::string(name).starts_with(prefix)) continue;
            const GLenum property = GL_OFFSET;
            const GLenum stride_property = GL_TOP_LEVEL_ARRAY_STRIDE;
            GLint offset = -1;
            GLint stride = 0;
            glGetProgramResourceiv(program, interface, index, 1, &property, 1, nullptr, &offset);
            if (interface == GL_BUFFER_VARIABLE)
                glGetProgramResourceiv(program, interface, index, 1, &stride_property, 1, nullptr, &stride);
            result.stride = static_cast<std::size_t>(stride);
            result.members.emplace_back(std::string(name).substr(prefix.size()), offset);
        }
        std::ranges::sort(result.members, {}, &decltype(result.members)::value_type::second);
        return result;
    }
};

TEST_F(SharedTypesTest, EveryMemberOfEveryStructureIsWhereBothCompilersSay) {
    const std::map<std::string, Layout> in_cpp = layoutsInCpp();
    const std::map<std::string, std::string> structures = structuresOfHeaders();
    EXPECT_EQ(in_cpp.size(), structures.size());
    for (const auto& [structure, header] : structures) {
        const auto known = in_cpp.find(structure);
        if (known == in_cpp.end()) {
            ADD_FAILURE() << structure << " of " << header << " is not in this test";
            continue;
        }
        const GLuint program = probe(structure, header);
        Layout in_glsl = reflect(program, structure);
        glDeleteProgram(program);
        if (isUniform(structure)) in_glsl.stride = known->second.stride;  // there is one
        EXPECT_EQ(in_glsl, known->second) << structure;
    }
}

TEST_F(SharedTypesTest, EveryShaderDeclaresItsBlocksInTheLayoutThatIsShared) {
    static const std::regex block(R"((layout\(([^)]*)\)[^;{}()]*)?\b(buffer|uniform)\s+\w+\s*\{([^}]*)\})");
    const std::map<std::string, std::string> structures = structuresOfHeaders();
    std::set<std::string> seen;
    for (const gl::EmbeddedShader& shader : gl::embeddedShaders()) {
        const std::string text(shader.text);
        for (std::sregex_iterator found(text.begin(), text.end(), block), end; found != end; ++found) {
            std::istringstream words((*found)[4].str());
            for (std::string word; words >> word;) {
                if (!structures.contains(word)) continue;
                seen.insert(word);
                const bool uniform = (*found)[3] == "uniform";
                EXPECT_EQ((*found)[2].str(), std::string(uniform ? "std140" : "std430"))
                    << shader.path << ": " << found->str();
                // Boxes of vehicles are written as storage, and read as uniforms.
                EXPECT_TRUE(uniform == isUniform(word) || word == "VehicleBox")
                    << shader.path << ": " << found->str();
            }
        }
    }
    for (const auto& [structure, header] : structures) {
        if (structure == "FieldCell") continue;  // shaders read its words, through a texture
        if (structure == "Drawn") continue;      // is a part of others
        EXPECT_TRUE(seen.contains(structure)) << structure << " is in no block of a shader";
    }
}

}  // namespace
}  // namespace throng::test
