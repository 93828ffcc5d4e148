// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <future>
#include <thread>
#include <vector>

namespace throng {

/// Calls work(first, last) for parts of [0, count) that lie side by side, one a core, and waits for all.
/// @param least how many are worth a thread of their own
template <class Work>
void doSideBySide(std::size_t count, std::size_t least, const Work& work) {
    const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
    const std::size_t parts = std::clamp<std::size_t>(count / std::max<std::size_t>(least, 1), 1, cores);
    const auto begin = [&](std::size_t part) { return count * part / parts; };
    std::vector<std::future<void>> others;
    for (std::size_t part = 1; part < parts; ++part)
        others.push_back(std::async(std::launch::async, [&, part] { work(begin(part), begin(part + 1)); }));
    work(0, begin(1));
    for (std::future<void>& other : others)
        other.get();
}

}  // namespace throng
