// SPDX-License-Identifier: Apache-2.0
#include "sim/field_solver.h"

#include <algorithm>
#include <utility>

#include "shaders/shared/simulation_types.h"

namespace throng::sim {
namespace {

const gl::Declaration kRelax = {"fields",
                                {"shaders/routes/field_relax.comp"},
                                {"Distances", "CellSteps", "ListedBlocks", "OpenSides", "OneWay"},
                                {"NextDistances", "ChangedBlocks"}};
const gl::Declaration kKeep = {
    "fields", {"shaders/routes/field_keep.comp"}, {"ListedBlocks", "NextDistances"}, {"Distances"}};
const gl::Declaration kList = {"fields",
                               {"shaders/routes/field_list.comp"},
                               {"ChangedBlocks", "BlockDispatch"},
                               {"BlockDispatch", "ListedBlocks"}};

/// Rounds between two questions whether anything is left: asking waits for the device.
constexpr int kRoundsAtATime = 8;

std::vector<float> finite(const std::vector<float>& values, float scale = 1.0f) {
    std::vector<float> result(values.size());
    std::transform(values.begin(), values.end(), result.begin(), [&](float value) {
        return value < authoring::kUnreachable ? value * scale : gpu::FIELD_FAR;
    });
    return result;
}

std::uint32_t blocksAlong(std::uint32_t cells) {
    return (cells + gpu::FIELD_BLOCK_SIDE - 1) / gpu::FIELD_BLOCK_SIDE;
}

/// Blocks that have a place to start from: the first round looks at these, and at those beside them.
std::vector<std::uint32_t> startingBlocks(const authoring::FieldGrid& grid, const std::vector<float>& start) {
    const std::uint32_t across = blocksAlong(grid.width);
    std::vector<std::uint32_t> blocks(std::size_t{across} * blocksAlong(grid.height), 0);
    for (std::uint32_t y = 0; y < grid.height; ++y)
        for (std::uint32_t x = 0; x < grid.width; ++x)
            if (start[std::size_t{y} * grid.width + x] < authoring::kUnreachable)
                blocks[y / gpu::FIELD_BLOCK_SIDE * across + x / gpu::FIELD_BLOCK_SIDE] = 1;
    return blocks;
}

}  // namespace

FieldSolver::FieldSolver(const gl::ShaderLibrary& library)
    : library_(library),
      no_blocks_(gl::makeBuffer("no blocks", std::vector<std::uint32_t>{0, 1, 1})),
      block_dispatch_("block dispatch", no_blocks_.bytes()) {}

FieldSolver::Programs FieldSolver::programsFor(const authoring::WalkMap& map) const {
    const gl::Definitions definitions = map.isBound() ? gl::Definitions{{"BOUND", "1"}} : gl::Definitions{};
    Programs programs{gl::ComputeProgram(library_, kRelax, definitions), gl::ComputeProgram(library_, kKeep),
                      gl::ComputeProgram(library_, kList)};
    for (gl::ComputeProgram* program : {&programs.relax, &programs.keep, &programs.list}) {
        program->bindAll({{"CellSteps", &steps_},
                          {"OpenSides", &open_sides_},
                          {"OneWay", &one_way_},
                          {"Distances", &distances_},
                          {"NextDistances", &next_distances_},
                          {"ChangedBlocks", &changed_},
                          {"ListedBlocks", &listed_},
                          {"BlockDispatch", &block_dispatch_}});
        program->set("grid_size", glm::uvec2(map.grid.width, map.grid.height));
    }
    return programs;
}

void FieldSolver::iterate(Programs& programs, std::uint32_t blocks) {
    do {
        for (int round = 0; round < kRoundsAtATime; ++round) {
            block_dispatch_.copyFrom(no_blocks_);
            programs.list.dispatch(blocks);
            changed_.fill(0);
            programs.relax.dispatchIndirect(block_dispatch_);
            programs.keep.dispatchIndirect(block_dispatch_);
        }
    } while (block_dispatch_.download<std::uint32_t>(1).front() > 0);
}

std::vector<float> FieldSolver::solve(const authoring::WalkMap& map, const std::vector<float>& start) {
    steps_ = gl::makeBuffer("cell steps", finite(map.cost, map.grid.cell_size));
    const std::size_t cells = map.cost.size();
    std::vector<std::uint32_t> sides(map.isBound() ? cells : 0, gpu::OPEN_TO_X | gpu::OPEN_TO_Y);
    std::copy(map.open_sides.begin(), map.open_sides.end(), sides.begin());
    open_sides_ = gl::makeBuffer("open sides", sides);
    std::vector<glm::vec2> one_way(map.isBound() ? cells : 0, glm::vec2(0.0f));
    std::copy(map.one_way.begin(), map.one_way.end(), one_way.begin());
    one_way_ = gl::makeBuffer("one way", one_way);
    distances_ = gl::makeBuffer("distances", finite(start));
    next_distances_ = gl::Buffer("next distances", distances_.bytes());
    const std::vector<std::uint32_t> changed = startingBlocks(map.grid, start);
    changed_ = gl::makeBuffer("changed blocks", changed);
    listed_ = gl::Buffer("listed blocks", changed_.bytes());

    Programs programs = programsFor(map);
    iterate(programs, static_cast<std::uint32_t>(changed.size()));
    std::vector<float> distances = distances_.download<float>(cells);
    for (float& distance : distances)
        if (distance >= gpu::FIELD_FAR) distance = authoring::kUnreachable;
    return distances;
}

}  // namespace throng::sim
