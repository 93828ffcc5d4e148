// SPDX-License-Identifier: Apache-2.0
#include "cli/baking/empty_watch.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace throng::cli {

bool EmptyWatch::take(const Frame& frame) {
    if (has_ended_) return false;
    const std::span<const float> states = frame[Stream::state];
    bool is_empty = true, were_all = true;
    for (std::size_t row = 0; row < was_there_.size(); ++row) {
        const bool is_there = states[row * kComponents] > 0.5f;
        is_empty = is_empty && !is_there;
        was_there_[row] |= is_there ? 1 : 0;
        were_all = were_all && was_there_[row];
    }
    empty_frames_ = is_empty && were_all && !was_there_.empty() ? empty_frames_ + 1 : 0;
    has_ended_ = empty_frames_ > after_;
    return true;
}

std::vector<std::byte> EmptyWatch::save() const {
    std::vector<std::byte> saved(sizeof empty_frames_ + was_there_.size());
    std::memcpy(saved.data(), &empty_frames_, sizeof empty_frames_);
    std::transform(was_there_.begin(), was_there_.end(), saved.begin() + sizeof empty_frames_,
                   [](std::uint8_t was) { return std::byte{was}; });
    return saved;
}

void EmptyWatch::restore(std::span<const std::byte> saved) {
    if (saved.size() != sizeof empty_frames_ + was_there_.size())
        throw std::runtime_error("the checkpoint tells of another crowd who has been there");
    std::memcpy(&empty_frames_, saved.data(), sizeof empty_frames_);
    has_ended_ = empty_frames_ > after_;
    std::transform(saved.begin() + sizeof empty_frames_, saved.end(), was_there_.begin(),
                   [](std::byte was) { return std::to_integer<std::uint8_t>(was) & std::uint8_t{1}; });
}

}  // namespace throng::cli
