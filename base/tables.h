// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace throng {

/// Whether each row of a table stands where the number of its `id` says, so that it can be found by that.
template <class Table>
constexpr bool isInOrder(const Table& table) {
    for (std::size_t i = 0; i < table.size(); ++i)
        if (static_cast<std::size_t>(table[i].id) != i) return false;
    return true;
}

}  // namespace throng
