// SPDX-License-Identifier: Apache-2.0
#include "sim/sensing.h"

#include "sim/wall_index.h"

namespace throng::sim {
namespace {

const gl::Declaration kMarch = {
    "sensing",
    {"shaders/sensing/sense.comp"},
    {"ParametersBlock", "LiveDispatch", "Bands", "SlotImages", "Bodies", "StripStarts", "CellOffsets",
     "WallSegments", "WallStarts", "NarrowCells", "WallTiles", "owners", "page_table", "SensingPattern",
     "TouchDispatch", "VehicleBoxes"},
    {"Neighbours", "NeighbourCounts", "TouchWords", "TouchLists", "TouchSlots", "TouchDispatch"}};
const gl::Declaration kCompare = {
    "sensing",
    {"shaders/sensing/sense_exact.comp"},
    {"ParametersBlock", "LiveDispatch", "SlotImages", "Bodies", "StripStarts", "CellOffsets", "WallSegments",
     "WallStarts", "NarrowCells", "FarWallStarts", "FarWallItems", "TouchDispatch", "VehicleBoxes"},
    {"Neighbours", "NeighbourCounts", "TouchWords", "TouchLists", "TouchSlots", "TouchDispatch"}};

}  // namespace

Sensing::Sensing(const gl::ShaderLibrary& library, Buffers& buffers, const Diagram& diagram,
                 const SensingOptions& options, const authoring::Scene& scene,
                 const gpu::Parameters& parameters)
    : buffers_(buffers), diagram_(diagram), proximity_(options.proximity) {
    if (needsDiagram())
        marchRays(library, diagram, options);
    else
        compareExactly(library, options, scene, parameters);
    program_.set("slot_capacity", buffers.slotCapacity());
}

void Sensing::marchRays(const gl::ShaderLibrary& library, const Diagram& diagram,
                        const SensingOptions& options) {
    std::vector<glm::vec2> pattern = thinnedPattern(options.geometry, options.felt_range);
    // Elements hold two samples: one that comes twice shows nobody new.
    if (pattern.size() % 2 != 0) pattern.push_back(pattern.back());
    gl::Definitions definitions = {{"NEIGHBOURS", std::to_string(options.neighbours)}};
    if (buffers_.hasCharts()) definitions.emplace_back("CHARTS", "1");
    for (const auto& definition : buffers_.trafficDefinitions())
        definitions.push_back(definition);
    definitions.emplace_back("SENSING_SAMPLES", std::to_string(pattern.size()));
    for (const auto& definition : diagram.lookupDefinitions())
        definitions.push_back(definition);
    program_ = buffers_.connect(library, kMarch, definitions);
    diagram.describeTo(program_);
    program_.setIfUsed("first_vehicle", diagram.firstVehicle());
    pattern_ = gl::makeBuffer("sensing pattern", pattern);
    program_.bind("SensingPattern", pattern_);
}

void Sensing::compareExactly(const gl::ShaderLibrary& library, const SensingOptions& options,
                             const authoring::Scene& scene, const gpu::Parameters& parameters) {
    const float reach = sensingReach(options.geometry);
    const bool everybody = proximity_ == authoring::Proximity::brute;
    gl::Definitions definitions = {{"NEIGHBOURS", std::to_string(options.neighbours)}};
    if (buffers_.hasCharts()) definitions.emplace_back("CHARTS", "1");
    for (const auto& definition : buffers_.trafficDefinitions())
        definitions.push_back(definition);
    if (everybody) definitions.emplace_back("EVERYBODY", "1");
    program_ = buffers_.connect(library, kCompare, definitions);
    program_.set("reach", reach);
    program_.set("half_view", 0.5f * options.geometry.field_of_view);
    if (everybody) {
        program_.set("wall_count", static_cast<std::uint32_t>(scene.wall_segments.size()));
        return;
    }
    const WallIndex walls = indexWalls(scene.wall_segments, parameters, reach);
    far_wall_starts_ = gl::makeBuffer("walls within reach, starts", walls.starts, "cell");
    far_wall_items_ = gl::makeBuffer("walls within reach", walls.items, "wall near a cell");
    program_.bind("FarWallStarts", far_wall_starts_);
    program_.bind("FarWallItems", far_wall_items_);
}

void Sensing::run(std::uint32_t band) {
    diagram_.lookUpInBand(program_, band);
}

void Sensing::run() {
    program_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
}

}  // namespace throng::sim
