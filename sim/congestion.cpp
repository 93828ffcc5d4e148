// SPDX-License-Identifier: Apache-2.0
#include "sim/congestion.h"

#include <cmath>

namespace throng::sim {
namespace {

constexpr std::uint32_t kStepsPerLook = 4;   // the crowd is looked at this often
constexpr float kMemory = 1.0f;              // s: and remembered with this time constant
constexpr std::uint32_t kStepsPerRound = 4;  // every field is relaxed once within this many steps

}  // namespace

Congestion::Congestion(const gl::ShaderLibrary& library, Buffers& buffers, const authoring::Scene& scene,
                       const gpu::Parameters& parameters) {
    const authoring::Detours& detours = scene.detours;
    if (detours.distances.empty()) return;
    cells_ = parameters.detour_width * parameters.detour_height;
    fields_ = static_cast<std::uint32_t>(detours.ground_of_field.size());
    fields_per_step_ = (fields_ + kStepsPerRound - 1) / kStepsPerRound;
    ground_of_field_ = detours.ground_of_field;
    has_choice_ = detours.has_choice;
    has_choice_.resize(fields_);
    ground_ = gl::makeBuffer("ground", detours.ground);
    free_distances_ = gl::makeBuffer("free distances", detours.distances);
    distances_ = gl::makeBuffer("detour distances", detours.distances);
    next_distances_ = gl::Buffer("next distances", sizeof(float) * cells_);
    flows_ = gl::Buffer("crowd flows", sizeof(gpu::CrowdFlow) * cells_);
    flows_.fill(0);

    std::vector<std::pair<std::string, const gl::Buffer*>> named = buffers.named();
    named.insert(named.end(), {{"Ground", &ground_},
                               {"FreeDistances", &free_distances_},
                               {"DetourDistances", &distances_},
                               {"NextDistances", &next_distances_},
                               {"CrowdFlows", &flows_}});
    flow_ = gl::ComputeProgram(library, "shaders/detour_flow.comp");
    relax_ = gl::ComputeProgram(library, "shaders/detour_relax.comp");
    slope_ = gl::ComputeProgram(library, "shaders/detour_slope.comp");
    for (gl::ComputeProgram* program : {&flow_, &relax_, &slope_})
        program->bindAll(named);
    flow_.set("fading",
              1.0f - std::exp(-static_cast<float>(kStepsPerLook) * parameters.step_seconds / kMemory));
}

void Congestion::run() {
    if (fields_ == 0) return;
    if (steps_++ % kStepsPerLook == 0) flow_.dispatch(cells_);
    for (std::uint32_t i = 0; i < fields_per_step_; ++i) {
        relax(next_field_);
        next_field_ = (next_field_ + 1) % fields_;
    }
}

void Congestion::relax(std::uint32_t field) {
    relax_.set("field", field);
    relax_.set("ground_map", ground_of_field_[field]);
    relax_.set("has_choice", has_choice_[field] ? 1u : 0u);
    relax_.dispatch(cells_);
    slope_.set("field", field);
    slope_.set("ground_map", ground_of_field_[field]);
    slope_.dispatch(cells_);
}

}  // namespace throng::sim
