// SPDX-License-Identifier: Apache-2.0
#include "sim/hiding.h"

#include <vector>

#include "sim/wall_index.h"

namespace throng::sim {
namespace {

const gl::Declaration kHiding = {"sensing",
                                 {"shaders/sensing/out_of_sight.comp"},
                                 {"ParametersBlock", "LiveDispatch", "SlotImages", "Bodies", "WallSegments",
                                  "HidingStarts", "HidingItems", "Neighbours", "NeighbourCounts"},
                                 {"Neighbours", "NeighbourCounts"}};

}  // namespace

Hiding::Hiding(const gl::ShaderLibrary& library, const Buffers& buffers, const authoring::Scene& scene,
               const gpu::Parameters& parameters, float reach)
    : buffers_(buffers), program_(buffers.connect(library, kHiding, buffers.definitions())) {
    std::vector<gpu::WallSegment> walls;
    for (const std::uint32_t segment : scene.hiding_walls)
        walls.push_back(scene.wall_segments[segment]);
    WallIndex index = indexWalls(walls, parameters, reach);
    for (std::uint32_t& item : index.items)
        item = scene.hiding_walls[item];
    starts_ = gl::makeBuffer("walls that hide, starts", index.starts, "cell");
    items_ = gl::makeBuffer("walls that hide", index.items, "wall near a cell");
    program_.bind("HidingStarts", starts_);
    program_.bind("HidingItems", items_);
    program_.set("slot_capacity", buffers.slotCapacity());
}

void Hiding::run() {
    program_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
}

}  // namespace throng::sim
