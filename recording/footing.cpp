// SPDX-License-Identifier: Apache-2.0
#include "recording/footing.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shaders/shared/walking.h"

namespace throng::recording {
namespace {

constexpr float kSlopeReach = 0.25f;  // m before and behind the body: about where planted feet are
constexpr float kSideReach = 0.15f;   // m
constexpr double kSettling =
    0.25;  // s: who comes to a stand puts its feet beside each other with this time constant
constexpr float kSteepest = 1.2f;
constexpr float kHalfRiser = 0.125f;  // m: the smooth ground goes through the middle of risers

/// What stairs and kerbs make of the ground over the smooth one. Beside a drop it is more, as the smooth
/// ground bends down there: no foot takes that along to its next place.
float ofSteps(float step) {
    return glm::clamp(step, -kHalfRiser, kHalfRiser);
}

}  // namespace

Footing::Footing(std::shared_ptr<const authoring::Terrain> terrain, std::size_t rows, double fps)
    : terrain_(std::move(terrain)), fps_(fps), feet_(rows) {}

float Footing::stepAt(glm::vec2 place) const {
    return terrain_->heightAt(place) - terrain_->smoothAt(place);
}

Stance Footing::entering(glm::vec2 place, glm::vec2 heading) const {
    const authoring::Terrain::Face here = terrain_->faceAt(place);
    const glm::vec2 slopes(glm::dot(here.slope, heading),
                           glm::dot(here.slope, glm::vec2(-heading.y, heading.x)));
    return {here.height, glm::clamp(slopes.x, -kSteepest, kSteepest),
            glm::clamp(slopes.y, -kSteepest, kSteepest), here.height};
}

Stance Footing::stand(std::size_t row, const Walker& walker, const GaitTrack& gait) {
    const auto& [place, heading, moved, is_carried] = walker;
    Feet& feet = feet_[row];
    const glm::vec2 left(-heading.y, heading.x);
    const authoring::Terrain::Face here = terrain_->faceAt(place);
    const float smooth = terrain_->smoothAt(place);
    const float step_here = here.height - smooth;
    const double half_cycles = 2.0 * (gait.phase - kUnderBody);
    const double between = half_cycles - std::floor(half_cycles);
    const double step_length = 0.5 * strideOf(gait.gait);
    const float distance = glm::length(moved);
    const bool stands = distance * fps_ < gpu::STANDING_SPEED;
    const bool is_new = feet.known == 0;
    if (is_new) {
        feet.step_from = feet.step_to = ofSteps(step_here);
        feet.standing = 1.0f;
        feet.known = 1;
    }
    if (is_new || std::floor(half_cycles) != feet.half_cycle) {
        const glm::vec2 way = stands ? heading : moved / distance;
        if (!is_new) feet.step_from = feet.step_to;
        feet.step_to = ofSteps(stepAt(place + static_cast<float>((1.0 - between) * step_length) * way));
        feet.half_cycle = std::floor(half_cycles);
    }
    if (!is_new)
        feet.standing += ((stands ? 1.0f : 0.0f) - feet.standing) *
                         static_cast<float>(1.0 - std::exp(-1.0 / (fps_ * kSettling)));
    const float walking_step = glm::mix(feet.step_from, feet.step_to, static_cast<float>(between));
    const auto slope = [&](glm::vec2 direction, float reach) {
        return (terrain_->smoothAt(place + reach * direction) -
                terrain_->smoothAt(place - reach * direction)) /
               (2.0f * reach);
    };
    const glm::vec2 walking(
        slope(heading, kSlopeReach) + (feet.step_to - feet.step_from) / static_cast<float>(step_length),
        slope(left, kSideReach));
    const glm::vec2 standing =
        is_carried ? glm::vec2(0.0f) : glm::vec2(glm::dot(here.slope, heading), glm::dot(here.slope, left));
    const glm::vec2 slopes = glm::clamp(glm::mix(walking, standing, feet.standing), -kSteepest, kSteepest);
    const float of_the_drop = step_here - ofSteps(step_here);
    feet.stance = {smooth + of_the_drop + glm::mix(walking_step, ofSteps(step_here), feet.standing), slopes.x,
                   slopes.y, here.height};
    return feet.stance;
}

}  // namespace throng::recording
