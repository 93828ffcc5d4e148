// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <future>
#include <thread>
#include <vector>

namespace throng {

/// For std::async: where no thread can be begun, whoever waits for the result does the work itself.
constexpr std::launch kInAThread = std::launch::async | std::launch::deferred;

/// Calls work(first, last) for parts of [0, count) that lie side by side, one a core, and waits for all.
/// @param least how many are worth a thread of their own
template <class Work>
void doSideBySide(std::size_t count, std::size_t least, const Work& work) {
    const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
    const std::size_t parts = std::clamp<std::size_t>(count / std::max<std::size_t>(least, 1), 1, cores);
    const auto begin = [&](std::size_t part) { return count * part / parts; };
    std::vector<std::future<void>> others;
    for (std::size_t part = 1; part < parts; ++part)
        others.push_back(std::async(kInAThread, [&, part] { work(begin(part), begin(part + 1)); }));
    work(0, begin(1));
    for (std::future<void>& other : others)
        other.get();
}

/// Calls work(i) for all of [0, count), whichever thread comes to it, one a core, and waits for all: for what
/// takes long, and not equally long. Once one throws, nothing else is begun, and that is thrown.
template <class Work>
void doEach(std::size_t count, const Work& work) {
    std::atomic<std::size_t> next = 0;
    doSideBySide(std::min<std::size_t>(count, std::thread::hardware_concurrency()), 1,
                 [&](std::size_t, std::size_t) {
                     try {
                         for (std::size_t i = next++; i < count; i = next++)
                             work(i);
                     } catch (...) {
                         next = count;
                         throw;
                     }
                 });
}

}  // namespace throng
