// SPDX-License-Identifier: Apache-2.0
#include "sim/seats.h"

namespace throng::sim {
namespace {

const gl::Declaration kLead = {"seats",
                               {"shaders/seats/lead.comp"},
                               {"ParametersBlock", "People", "States", "Bodies", "StripStarts", "CellOffsets",
                                "BehaviourStates", "Minds", "SeatWays", "SeatPoints", "Sitters"},
                               {"States", "Chests", "SittersNext"}};
const gl::Declaration kMinds = {
    "behaviour",
    {"shaders/seats/minds.comp"},
    {"ParametersBlock", "People", "States", "Bodies", "StripStarts", "CellOffsets", "BehaviourStates",
     "BehaviourRules", "BehaviourPoints", "Censuses", "Tallies", "Minds", "SeatWays", "Sitters"},
    {"Minds"}};

}  // namespace

Seats::Seats(const gl::ShaderLibrary& library, Buffers& buffers, const authoring::Scene& scene,
             const MotionSettings& rules)
    : buffers_(buffers),
      count_(static_cast<std::uint32_t>(scene.seats.ways.size())),
      next_(gl::makeBuffer("next sitters", scene.seats.sitters, "person with a seat")),
      lead_(buffers.connect(library, kLead, buffers.definitions(rules))),
      minds_(buffers.connect(library, kMinds, buffers.definitions(rules))) {
    lead_.bind("SittersNext", next_);
    for (gl::ComputeProgram* program : {&lead_, &minds_})
        program->set("sitter_count", count_);
}

void Seats::lead(bool decides, std::uint32_t steps_done) {
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
