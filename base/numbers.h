// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Numbers as people read them.
namespace throng {

/// A number that is all of a text, and finite.
std::optional<double> finiteNumber(std::string_view text);

/// As it reads with so many digits: the same wherever it is printed.
double withDigits(double value, int digits);

/// Six digits say enough and read well.
double readable(double value);

/// 1234567 -> "1,234,567"
std::string grouped(std::uint64_t number);

/// 94371840 -> "90.0 MiB"
std::string readableBytes(std::uint64_t bytes);

/// The smallest of 1, 2, 5 times a power of ten that is not below `value`; `value` is more than 0.
double roundUpNicely(double value);

}  // namespace throng
