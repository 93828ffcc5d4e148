// SPDX-License-Identifier: Apache-2.0
#include "io/overrides/row_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace throng::io {
namespace {

using Values = std::array<float, kComponents>;

float between(float a, float b, double share) {
    return static_cast<float>(static_cast<double>(a) +
                              (static_cast<double>(b) - static_cast<double>(a)) * share);
}

double headingOf(const Values& direction) {
    return std::atan2(static_cast<double>(direction[1]), static_cast<double>(direction[0]));
}

/// The shorter way round from one heading to another.
double turnBetween(double from, double to) {
    return std::remainder(to - from, 2.0 * std::numbers::pi);
}

/// @param pace of rates, 0 where time stands
Values valuesBetween(const StreamInfo& info, const Values& before, const Values& after, double share,
                     double pace) {
    Values values = share < 0.5 ? before : after;
    for (std::size_t i = 0; i < kComponents; ++i) {
        const StreamComponent& component = info.components[i];
        if (component.between == Between::linear) values[i] = between(before[i], after[i], share);
        if (component.is_rate) values[i] = static_cast<float>(static_cast<double>(values[i]) * pace);
    }
    if (info.components[0].between != Between::heading) return values;
    const double from = headingOf(before);
    const double heading = from + turnBetween(from, headingOf(after)) * share;
    values[0] = static_cast<float>(std::cos(heading));
    values[1] = static_cast<float>(std::sin(heading));
    return values;
}

/// Places turn about the pivot and move; directions only turn.
void moveValues(Values& values, InPlane what, const Values& pivot, const authoring::PersonChange& change) {
    if (what == InPlane::nothing) return;
    const bool is_place = what == InPlane::place;
    const glm::dvec2 about = is_place ? glm::dvec2(pivot[0], pivot[1]) : glm::dvec2(0.0);
    const glm::dvec3 move = is_place ? change.move : glm::dvec3(0.0);
    const double angle = change.turn * std::numbers::pi / 180.0;
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const double x = static_cast<double>(values[0]) - about.x;
    const double y = static_cast<double>(values[1]) - about.y;
    values[0] = static_cast<float>(about.x + cosine * x - sine * y + move.x);
    values[1] = static_cast<float>(about.y + sine * x + cosine * y + move.y);
    values[2] = static_cast<float>(static_cast<double>(values[2]) + move.z);
}

/// Whoever hides is not there: zero where that is what the stream holds then.
void hide(Values& values, const StreamInfo& info) {
    for (std::size_t i = 0; i < kComponents; ++i)
        if (info.components[i].before_entry == BackFill::keep) values[i] = 0.0f;
}

}  // namespace

void changeSample(RowSample& sample, const Values& pivot, const authoring::PersonChange& change) {
    if (change.character) sample[Stream::state][1] = static_cast<float>(*change.character);
    for (const StreamInfo& info : kStreams) {
        if (change.moves()) moveValues(sample[info.id], info.in_plane, pivot, change);
        if (change.hides()) hide(sample[info.id], info);
    }
}

void hideSample(RowSample& sample) {
    for (const StreamInfo& info : kStreams)
        hide(sample[info.id], info);
}

RowSample sampleBetween(const std::function<RowSample(std::uint32_t)>& whole, std::uint32_t frames,
                        double frame, double pace) {
    const double inside = std::clamp(frame, 0.0, static_cast<double>(frames - 1));
    const auto low = static_cast<std::uint32_t>(std::floor(inside));
    const double share = inside - static_cast<double>(low);
    const RowSample before = whole(low);
    const RowSample after = share > 0.0 ? whole(low + 1) : before;
    RowSample sample;
    for (const StreamInfo& info : kStreams)
        sample[info.id] =
            valuesBetween(info, before[info.id], after[info.id], share, inside == frame ? pace : 0.0);
    return sample;
}

RowSample RowSampler::whole(std::uint32_t row, std::uint32_t frame) const {
    RowSample sample;
    for (const StreamInfo& info : kStreams)
        if (streams_.has(info.id)) streams_[info.id].readRows(frame, row, sample[info.id]);
    return sample;
}

}  // namespace throng::io
