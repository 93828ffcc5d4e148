// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "base/frame.h"

namespace throng::cli {

/// When a bake ends that ends once everybody has gone: everybody has been there, and for a while nobody has
/// been. Whoever never comes in is waited for to the end. What it finds depends on the frames alone, however
/// late it is asked.
class EmptyWatch {
  public:
    /// @param after frames without anybody that are still the bake's
    EmptyWatch(std::size_t rows, std::uint32_t after) : was_there_(rows, 0), after_(after) {}

    /// Somebody who has been there before the first frame, and gone.
    void hasGone(std::size_t row) { was_there_[row] = 1; }
    /// The next frame, in their order. @returns whether the bake has it
    bool take(const Frame& frame);
    /// Whether all frames of the bake have been taken. Any thread may ask.
    bool hasEnded() const { return has_ended_; }

    /// What has been seen so far, for a checkpoint, and from one. @throws std::runtime_error of another crowd
    std::vector<std::byte> save() const;
    void restore(std::span<const std::byte> saved);

  private:
    std::vector<std::uint8_t> was_there_;  // by row
    std::uint32_t after_, empty_frames_ = 0;
    std::atomic<bool> has_ended_ = false;
};

}  // namespace throng::cli
