// SPDX-License-Identifier: Apache-2.0
#include "io/streams/entered_hash.h"

#include <algorithm>

#include "base/frame.h"

namespace throng::io {

void EnteredHash::add(std::uint32_t frame, std::span<const float> values,
                      std::span<const std::uint32_t> first_alive) {
    counted_.assign(values.begin(), values.end());
    for (std::size_t row = 0; row < first_alive.size(); ++row)
        if (first_alive[row] > frame) std::ranges::fill(rowOf(std::span(counted_), row), 0.0f);
    hasher_.add(std::as_bytes(std::span(counted_)));
}

}  // namespace throng::io
