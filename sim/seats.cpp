// SPDX-License-Identifier: Apache-2.0
#include "sim/seats.h"

#include <algorithm>
#include <numeric>

namespace throng::sim {
namespace {

const gl::Declaration kListWalkers = {"seats",
                                      {"shaders/seats/walkers.comp"},
                                      {"SeatWays", "Sitters", "AisleCounts"},
                                      {"AisleCounts", "AisleWalkers"}};
const gl::Declaration kLead = {
    "seats",
    {"shaders/seats/lead.comp"},
    {"ParametersBlock", "People", "States", "Bodies", "StripStarts", "CellOffsets", "BehaviourStates",
     "Minds", "SeatWays", "SeatPoints", "SeatLanes", "LaneMates", "AisleCounts", "aisle_walkers", "Sitters"},
    {"States", "Chests", "SittersNext"}};
const gl::Declaration kMinds = {
    "behaviour",
    {"shaders/seats/minds.comp"},
    {"ParametersBlock", "People", "States", "Bodies", "StripStarts", "CellOffsets", "BehaviourStates",
     "BehaviourRules", "BehaviourPoints", "Censuses", "Tallies", "Minds", "SeatWays", "Sitters"},
    {"Minds"}};

/// Those who share an aisle and a row, one lane behind the other.
struct Lanes {
    std::vector<gpu::SeatLane> of_sitter;
    std::vector<std::uint32_t> mates;
};

Lanes lanesOf(const std::vector<gpu::SeatWay>& ways) {
    Lanes lanes{std::vector<gpu::SeatLane>(ways.size()), std::vector<std::uint32_t>(ways.size())};
    std::iota(lanes.mates.begin(), lanes.mates.end(), 0u);
    const auto lane = [&](std::uint32_t number) {
        return std::pair(ways[number].first_of_aisle, ways[number].lane);
    };
    std::ranges::stable_sort(lanes.mates, {}, lane);
    for (std::uint32_t first = 0, end = 0; first < lanes.mates.size(); first = end) {
        while (end < lanes.mates.size() && lane(lanes.mates[end]) == lane(lanes.mates[first]))
            ++end;
        for (std::uint32_t i = first; i < end; ++i)
            lanes.of_sitter[lanes.mates[i]] = {first, end - first};
    }
    return lanes;
}

constexpr const char* kSitter = "person with a seat";

}  // namespace

Seats::Seats(const gl::ShaderLibrary& library, Buffers& buffers, const authoring::Scene& scene,
             const MotionSettings& rules)
    : buffers_(buffers),
      count_(static_cast<std::uint32_t>(scene.seats.ways.size())),
      next_(gl::makeBuffer("next sitters", scene.seats.sitters, kSitter)),
      walkers_("walkers in aisles", {scene.seats.ways.size(), sizeof(gpu::AisleWalker), kSitter}),
      walker_texels_(walkers_, gl::WordTexture::Texel::four_words),
      walker_counts_("counts of walkers", {scene.seats.ways.size(), gl::kWord, kSitter}),
      list_walkers_(buffers.connect(library, kListWalkers, {})),
      lead_(buffers.connect(library, kLead, buffers.definitions(rules))),
      minds_(buffers.connect(library, kMinds, buffers.definitions(rules))) {
    const Lanes lanes = lanesOf(scene.seats.ways);
    lanes_ = gl::makeBuffer("lanes", lanes.of_sitter, kSitter);
    lane_mates_ = gl::makeBuffer("lane mates", lanes.mates, kSitter);
    lead_.bindAll({{"SittersNext", &next_},
                   {"SeatLanes", &lanes_},
                   {"LaneMates", &lane_mates_},
                   {"AisleCounts", &walker_counts_}});
    lead_.bind("aisle_walkers", walker_texels_);
    list_walkers_.bindAll({{"AisleCounts", &walker_counts_}, {"AisleWalkers", &walkers_}});
    for (gl::ComputeProgram* program : {&list_walkers_, &lead_, &minds_})
        program->set("sitter_count", count_);
}

void Seats::lead(bool decides, std::uint32_t steps_done) {
    walker_counts_.fill(0);
    list_walkers_.dispatch(count_);
    lead_.set("steps_done", steps_done);
    lead_.set("may_cross", decides ? 1u : 0u);
    lead_.dispatch(count_);
    buffers_.sitters.copyFrom(next_);
}

void Seats::think(float now, std::uint32_t steps_done) {
    minds_.set("now", now);
    minds_.set("steps_done", steps_done);
    minds_.dispatch(count_);
}

std::vector<std::pair<std::string, gl::Buffer*>> Seats::remembered() {
    // Who steps out looks at the cells as the last step left them: people are led before they are sorted
    // anew.
    return {{"sitters", &buffers_.sitters},
            {"bodies", &buffers_.bodies},
            {"strip starts", &buffers_.strip_starts},
            {"cell offsets", &buffers_.cell_offsets},
            {"row cells", &buffers_.row_cells}};
}

}  // namespace throng::sim
