// SPDX-License-Identifier: Apache-2.0
#include "recording/audience.h"

#include <algorithm>
#include <array>

namespace throng::recording {

ActivityNow activityAt(std::span<const Deed> deeds, double time) {
    const auto next = std::ranges::upper_bound(deeds, time, {}, &Deed::begin);
    if (next == deeds.begin()) return {};
    const Deed& deed = *std::prev(next);
    return {deed.activity, deed.phase + deed.rate * (time - deed.begin)};
}

Audience::Audience(const BakeDescription& description)
    : fps_(description.fps),
      people_(description.audience),
      heads_(description.eye_catchers, description.seed),
      written_(description.streams()) {}

Frame Audience::with(const Frame& frame) {
    if (people_.empty()) return frame;
    Frame all = frame;
    for (const StreamInfo& info : kStreams) {
        if (!written_[info.id]) continue;
        const std::span<const float> walkers = frame[info.id];
        std::vector<float>& values = values_[info.id];
        values.resize(walkers.size() + people_.size() * kComponents);
        std::ranges::copy(walkers, values.begin());
        fill(info.id, std::span(values).subspan(walkers.size()), frame.index / fps_);
        all[info.id] = values;
    }
    return all;
}

void Audience::fill(Stream stream, std::span<float> values, double time) const {
    for (std::size_t i = 0; i < people_.size(); ++i) {
        const BakeSpectator& person = people_[i];
        std::array<float, kComponents> told{};
        if (stream == Stream::pos) told = {person.place.x, person.place.y, person.height};
        if (stream == Stream::dir) told = {person.ahead.x, person.ahead.y, 0.0f};
        if (stream == Stream::ground) told = {0.0f, 0.0f, person.height};
        if (stream == Stream::state) {
            const ActivityNow now = activityAt(person.deeds, time);
            told = {static_cast<float>(now.activity), static_cast<float>(person.variation),
                    static_cast<float>(now.phase)};
        }
        if (stream == Stream::attention || stream == Stream::gaze) {
            const Attention head = heads_.at(person, i, time);
            told = stream == Stream::attention
                       ? std::array{head.yaw, head.pitch, head.weight}
                       : std::array{head.weight * head.yaw, head.weight * head.pitch, head.at};
        }
        std::ranges::copy(told, rowOf(values, i).begin());
    }
}

}  // namespace throng::recording
