// SPDX-License-Identifier: Apache-2.0
#include "base/side_by_side.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

namespace throng {
namespace {

TEST(SideBySide, PartsMakeUpTheWhole) {
    for (const std::size_t count : {0u, 1u, 63u, 1'234u}) {
        std::vector<int> times(count, 0);
        doSideBySide(count, 10, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                ++times[i];
        });
        EXPECT_EQ(times, std::vector<int>(count, 1));
    }
}

TEST(SideBySide, EachIsDoneOnce) {
    for (const std::size_t count : {0u, 1u, 63u, 1'234u}) {
        std::vector<int> times(count, 0);
        doEach(count, [&](std::size_t i) { ++times[i]; });
        EXPECT_EQ(times, std::vector<int>(count, 1));
    }
}

TEST(SideBySide, WhatIsThrownInAnyThreadIsThrown) {
    for (const std::size_t at : {0u, 1u, 62u}) {
        EXPECT_THROW(doEach(63,
                            [&](std::size_t i) {
                                if (i == at) throw std::bad_alloc();
                            }),
                     std::bad_alloc);
        EXPECT_THROW(doSideBySide(63, 1,
                                  [&](std::size_t first, std::size_t last) {
                                      if (first <= at && at < last) throw std::bad_alloc();
                                  }),
                     std::bad_alloc);
    }
}

TEST(SideBySide, NothingIsBegunAfterAFailure) {
    constexpr std::size_t kCount = 1'000'000;
    std::atomic<std::size_t> begun = 0;
    EXPECT_THROW(doEach(kCount,
                        [&](std::size_t) {
                            ++begun;
                            throw std::runtime_error("no");
                        }),
                 std::runtime_error);
    EXPECT_LE(begun, std::max(1u, std::thread::hardware_concurrency()));
}

}  // namespace
}  // namespace throng
