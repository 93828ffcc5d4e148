// SPDX-License-Identifier: Apache-2.0
#include "io/overrides/row_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace throng::io {
namespace {

float between(float a, float b, double share) {
    return static_cast<float>(static_cast<double>(a) +
                              (static_cast<double>(b) - static_cast<double>(a)) * share);
}

double headingOf(const std::array<float, kComponents>& direction) {
    return std::atan2(static_cast<double>(direction[1]), static_cast<double>(direction[0]));
}

/// The shorter way round from one heading to another.
double turnBetween(double from, double to) {
    return std::remainder(to - from, 2.0 * std::numbers::pi);
}

}  // namespace

void changeSample(RowSample& sample, const std::array<float, kComponents>& pivot,
                  const authoring::PersonChange& change) {
    if (change.moves()) {
        const double angle = change.turn * std::numbers::pi / 180.0;
        const double cosine = std::cos(angle), sine = std::sin(angle);
        const double x = static_cast<double>(sample.position[0]) - static_cast<double>(pivot[0]);
        const double y = static_cast<double>(sample.position[1]) - static_cast<double>(pivot[1]);
        sample.position[0] =
            static_cast<float>(static_cast<double>(pivot[0]) + cosine * x - sine * y + change.move.x);
        sample.position[1] =
            static_cast<float>(static_cast<double>(pivot[1]) + sine * x + cosine * y + change.move.y);
        sample.position[2] = static_cast<float>(static_cast<double>(sample.position[2]) + change.move.z);
        const double dx = static_cast<double>(sample.direction[0]);
        const double dy = static_cast<double>(sample.direction[1]);
        sample.direction[0] = static_cast<float>(cosine * dx - sine * dy);
        sample.direction[1] = static_cast<float>(sine * dx + cosine * dy);
    }
    if (change.character) sample.state[1] = static_cast<float>(*change.character);
    if (!change.hides()) return;
    sample.state[0] = 0.0f;
    sample.density = {};
}

RowSample RowSampler::whole(std::uint32_t row, std::uint32_t frame) const {
    RowSample sample;
    positions_.readRows(frame, row, sample.position);
    directions_.readRows(frame, row, sample.direction);
    states_.readRows(frame, row, sample.state);
    if (densities_) densities_->readRows(frame, row, sample.density);
    return sample;
}

RowSample RowSampler::at(std::uint32_t row, double frame, double pace) const {
    const double last = static_cast<double>(positions_.frames() - 1);
    const double inside = std::clamp(frame, 0.0, last);
    const auto low = static_cast<std::uint32_t>(std::floor(inside));
    const double share = inside - static_cast<double>(low);
    const RowSample before = whole(row, low);
    const RowSample after = share > 0.0 ? whole(row, low + 1) : before;
    RowSample sample = share < 0.5 ? before : after;  // activity and variation
    for (std::size_t i = 0; i < kComponents; ++i) {
        sample.position[i] = between(before.position[i], after.position[i], share);
        sample.density[i] = between(before.density[i], after.density[i], share);
    }
    const double from = headingOf(before.direction);
    const double heading = from + turnBetween(from, headingOf(after.direction)) * share;
    const bool is_beyond = inside != frame;
    const double speed = static_cast<double>(between(before.direction[2], after.direction[2], share)) * pace;
    sample.direction = {static_cast<float>(std::cos(heading)), static_cast<float>(std::sin(heading)),
                        is_beyond ? 0.0f : static_cast<float>(speed)};
    sample.state[2] = between(before.state[2], after.state[2], share);
    return sample;
}

}  // namespace throng::io
