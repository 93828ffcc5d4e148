// SPDX-License-Identifier: Apache-2.0
#include "recording/gaits.h"

#include <algorithm>
#include <cmath>

#include "shaders/shared/walking.h"

namespace throng::recording {
namespace {

constexpr std::uint32_t kNormal = 3;      // of adults: 1.34 m/s
constexpr std::uint32_t kSettingOff = 1;  // of those who begin to walk
constexpr double kStandsAfter = 0.5;      // s: until then the stride that somebody stopped in is still seen
constexpr double kRatio = 1.28;           // of a gait's stride to the one before
constexpr double kStrideAtOne = 1.249;    // m at 1 m/s
constexpr double kStays = 0.6;            // gaits: speeds jitter, one that is nearly as good stays

/// Where among the gaits somebody of this speed would be.
double gaitScale(double speed) {
    return kNormal +
           std::log(kStrideAtOne * std::sqrt(std::max(speed, 1.0e-3)) / kNormalStride) / std::log(kRatio);
}

/// Cycles until a planted foot is next under the body: twice a cycle, once for each foot.
double untilUnderBody(double phase) {
    const double half = 2.0 * (phase - kUnderBody);
    return 0.5 * (std::floor(half) + 1.0 - half);
}

}  // namespace

double strideOf(std::uint32_t gait) {
    return kNormalStride * std::pow(kRatio, static_cast<double>(gait) - kNormal);
}

GaitInState gaitsOf(float state) {
    const float all = state - std::floor(state);
    const float gait = std::round(all / kGaitInState);
    const long rest = std::lround((all - gait * kGaitInState) / kLeftInState);
    return {static_cast<std::uint32_t>(gait), static_cast<std::uint32_t>(rest / 16),
            static_cast<double>(rest % 16) / 16.0};
}

double GaitTrack::left() const {
    return std::clamp(1.0 - (phase - changed) / kGaitsBlendOver, 0.0, 1.0);
}

float GaitTrack::inState() const {
    const auto sixteenths = static_cast<float>(std::min(15l, std::lround(16.0 * left())));
    if (sixteenths == 0.0f) return kGaitInState * static_cast<float>(gait);
    return kGaitInState * static_cast<float>(gait) + kBeforeInState * static_cast<float>(before) +
           kLeftInState * sixteenths;
}

std::uint32_t gaitFor(double speed) {
    return static_cast<std::uint32_t>(std::clamp(std::round(gaitScale(speed)), 0.0, kGaits - 1.0));
}

std::vector<double> allStrides() {
    std::vector<double> strides;
    for (std::uint32_t gait = 0; gait < kGaits; ++gait)
        strides.push_back(strideOf(gait));
    return strides;
}

void GaitTrack::advance(double way, double seconds) {
    const double speed = way / seconds;
    stood = speed < gpu::STANDING_SPEED ? stood + seconds : 0.0;
    if (stood > 0.0) {
        phase += way / strideOf(gait);
        if (stood < kStandsAfter) return;
        gait = kSettingOff;
        changed = kLongAgo;
        return;
    }
    const double until = untilUnderBody(phase) * strideOf(gait);
    const bool changes = std::abs(gaitScale(speed) - gait) >= kStays;
    if (!changes || way < until) {
        phase += way / strideOf(gait);
        return;
    }
    phase += until / strideOf(gait);
    before = gait;
    changed = phase;
    gait = gaitFor(speed);
    phase += (way - until) / strideOf(gait);
}

}  // namespace throng::recording
