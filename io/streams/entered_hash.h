// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/files/hash.h"

namespace throng::io {

/// What is said of a file that is not what it was when the checkpoint was made.
inline constexpr const char* kDoesNotFitCheckpoint =
    "is not what it was at the last checkpoint, so nothing goes on from there; --force starts over";

/// XXH3 of the frames of a stream, in which rows count from the frame they enter in: what they hold before
/// is filled in when the bake ends, and a bake may be killed in the middle of that.
class EnteredHash {
  public:
    /// @param first_alive per row, the first frame it is alive in, as far as is known up to this frame
    void add(std::uint32_t frame, std::span<const float> values, std::span<const std::uint32_t> first_alive);
    std::uint64_t digest() const { return hasher_.digest(); }

  private:
    Hasher hasher_;
    std::vector<float> counted_;
};

}  // namespace throng::io
