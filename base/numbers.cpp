// SPDX-License-Identifier: Apache-2.0
#include "base/numbers.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace throng {

std::optional<double> finiteNumber(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_whole = error == std::errc() && end == text.data() + text.size();
    return is_whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

double withDigits(double value, int digits) {
    if (!std::isfinite(value)) return value;
    return finiteNumber(fmt::format("{:.{}g}", value, digits)).value_or(value);
}

double readable(double value) {
    return withDigits(value, 6);
}

std::string grouped(std::uint64_t number) {
    std::string text = std::to_string(number);
    for (std::size_t at = text.size(); at > 3;) {
        at -= 3;
        text.insert(at, 1, ',');
    }
    return text;
}

std::string readableBytes(std::uint64_t bytes) {
    if (bytes < 1024) return fmt::format("{} bytes", bytes);
    double value = static_cast<double>(bytes);
    const char* unit = "";
    for (const char* next : {"KiB", "MiB", "GiB", "TiB"}) {
        if (value < 1024.0) break;
        value /= 1024.0;
        unit = next;
    }
    return fmt::format("{:.1f} {}", value, unit);
}

double roundUpNicely(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0})
        if (step * power >= value * (1.0 - 1e-9)) return step * power;
    return 10.0 * power;
}

}  // namespace throng
