// SPDX-License-Identifier: Apache-2.0
#include "base/numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace throng {
namespace {

TEST(WithDigits, ReadsAsItIsPrinted) {
    EXPECT_EQ(withDigits(0.1 + 0.2, 12), 0.3);
    EXPECT_EQ(withDigits(123456.789, 6), 123457.0);
    EXPECT_EQ(withDigits(-2.0 / 3.0, 6), -0.666667);
}

TEST(WithDigits, TakesWhateverANumberMayBe) {
    const double smallest = std::numeric_limits<double>::denorm_min();
    const double largest = std::numeric_limits<double>::max();
    EXPECT_LE(withDigits(smallest, 12), 2.0 * smallest);
    EXPECT_EQ(withDigits(largest, 6), 1.79769e308);
    EXPECT_EQ(withDigits(largest, 3), largest) << "rounded up, it would be none any more";
    EXPECT_TRUE(std::isnan(withDigits(std::nan(""), 6)));
    EXPECT_TRUE(std::isinf(withDigits(-std::numeric_limits<double>::infinity(), 6)));
}

}  // namespace
}  // namespace throng
