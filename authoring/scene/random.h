// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "authoring/layout.h"
#include "base/random.h"

/// Randomness by counting: a number depends on the seed, its group's id, the person and the purpose, and on
/// nothing drawn before, so adding a flow changes nobody in the others. The standard library's distributions
/// differ between implementations: not used.
namespace throng::authoring {

enum class Purpose : std::uint64_t {
    speed,
    radius,
    time,
    phase,
    variation,
    jitter_x,
    jitter_y,
    kind,
    goal_x,
    goal_y,
    party,
    reaction,
    choice,
    wait,
    breadth,
    depth,
    seat,
    show,
    lasts,
    pace
};

class GroupRandom {
  public:
    GroupRandom(std::uint64_t seed, std::string_view group_id) : key_(scramble(seed) ^ wordOf(group_id)) {}

    std::uint64_t word(std::uint64_t person, Purpose purpose, std::uint64_t draw = 0) const {
        return scramble(key_ ^ scramble(person ^ scramble(static_cast<std::uint64_t>(purpose) << 32 | draw)));
    }
    /// In [0, 1).
    double unit(std::uint64_t person, Purpose purpose, std::uint64_t draw = 0) const {
        return fractionOf(word(person, purpose, draw));
    }
    /// @param nth tells apart draws for one purpose
    double draw(const Distribution& distribution, std::uint64_t person, Purpose purpose,
                std::uint64_t nth = 0) const {
        switch (distribution.kind) {
            case Distribution::Kind::constant:
                return distribution.mean;
            case Distribution::Kind::uniform:
                return distribution.minimum +
                       (distribution.maximum - distribution.minimum) * unit(person, purpose, 2 * nth);
            case Distribution::Kind::normal:
            case Distribution::Kind::log_normal:
                break;
        }
        // Box and Muller 1958.
        const double radius = std::sqrt(-2.0 * std::log(1.0 - unit(person, purpose, 2 * nth)));
        const double normal = radius * std::cos(2.0 * std::numbers::pi * unit(person, purpose, 2 * nth + 1));
        const double value = distribution.mean + distribution.standard_deviation * normal;
        return std::clamp(distribution.kind == Distribution::Kind::log_normal ? std::exp(value) : value,
                          distribution.minimum, distribution.maximum);
    }

  private:
    std::uint64_t key_;
};

}  // namespace throng::authoring
