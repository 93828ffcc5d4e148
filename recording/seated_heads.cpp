// SPDX-License-Identifier: Apache-2.0
#include "recording/seated_heads.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "base/random.h"
#include "recording/head_turn.h"

namespace throng::recording {
namespace {

constexpr double kSlot = 6.0;     // s: in each of them one look, or none
constexpr double kSitsUp = 1.25;  // m, of eyes over the floor
constexpr double kClip = 2.0;     // as much as this weighs what the clip does

/// From 0 to 1 with the least jerk.
double gone(double share) {
    const double x = std::clamp(share, 0.0, 1.0);
    return x * x * x * (10.0 + x * (6.0 * x - 15.0));
}

}  // namespace

SeatedHeads::SeatedHeads(std::vector<EyeCatcher> things, std::uint64_t seed)
    : things_(std::move(things)), seed_(seed) {}

double SeatedHeads::Look::share(double time) const {
    if (at == 0) return 0.0;
    const double turn = secondsToTurn(1.3 * std::hypot(yaw, pitch));
    return gone((time - begin) / turn) - gone((time - begin - turn - lasts) / turn);
}

SeatedHeads::Look SeatedHeads::lookAt(const BakeSpectator& person, std::size_t thing) const {
    const glm::dvec2 away = things_[thing].place - glm::dvec2(person.place), ahead = person.ahead;
    const double yaw = std::atan2(ahead.x * away.y - ahead.y * away.x, glm::dot(ahead, away));
    const double pitch =
        std::atan2(things_[thing].height - double{person.height} - kSitsUp, glm::length(away));
    return {std::clamp(yaw, -kMostYaw, kMostYaw), std::clamp(pitch, -kMostPitch, kMostPitch), 0.0, 0.0,
            kFirstThing - static_cast<int>(thing)};
}

bool SeatedHeads::isNear(const BakeSpectator& person, std::size_t thing) const {
    return !things_[thing].is_audience &&
           glm::distance(things_[thing].place, glm::dvec2(person.place)) <= things_[thing].reach;
}

bool SeatedHeads::isSeen(const Look& look, const BakeSpectator& person, std::size_t thing) const {
    const glm::dvec2 away = things_[thing].place - glm::dvec2(person.place);
    return std::abs(look.yaw) < kMostYaw ||
           glm::dot(away, glm::dvec2(person.ahead)) > glm::length(away) * std::cos(kField);
}

/// The look of somebody in the slot of time that it is in.
SeatedHeads::Look SeatedHeads::spell(const BakeSpectator& person, std::size_t number, double time) const {
    const std::uint64_t key = scramble(seed_ ^ scramble(number ^ 0x73656174u));
    const double slots = time / kSlot + fractionOf(key), slot = std::floor(slots);
    const std::uint64_t word = scramble(key + static_cast<std::uint64_t>(slot) + 1);
    const double begin = time - (slots - slot) * kSlot;
    double total = kClip, drawn = fractionOf(word);
    Look found;
    for (std::size_t i = 0; i < things_.size(); ++i) {
        if (begin < things_[i].from || begin + kSlot > things_[i].until || things_[i].weight <= 0.0) continue;
        if (!isNear(person, i)) continue;
        const Look look = lookAt(person, i);
        if (!isSeen(look, person, i)) continue;
        total += things_[i].weight;
        const double share = things_[i].weight / total;
        if (drawn < share) found = look;
        drawn = drawn < share ? drawn / share : (drawn - share) / (1.0 - share);
    }
    found.begin = begin + fractionOf(scramble(word));
    found.lasts = 1.5 + 1.4 * fractionOf(scramble(word + 1));
    return found;
}

Attention SeatedHeads::at(const BakeSpectator& person, std::size_t number, double time) const {
    if (things_.empty()) return {};
    const Look look = spell(person, number, time);
    const double looked = look.share(time);
    double yaw = looked * look.yaw, pitch = looked * look.pitch, weight = looked;
    int at = looked > 0.0 ? look.at : 0;
    for (std::size_t i = 0; i < things_.size(); ++i) {
        if (!things_[i].loud || time < things_[i].from || !isNear(person, i)) continue;
        Look heard = lookAt(person, i);
        if (!isSeen(heard, person, i)) continue;
        const std::uint64_t word = scramble(seed_ ^ scramble((std::uint64_t{i} << 32) | number));
        heard.begin = things_[i].from + 0.2 + 0.3 * fractionOf(word);
        heard.lasts = 1.0 + 2.0 * fractionOf(scramble(word));
        const double share = heard.share(time);
        yaw = std::lerp(yaw, heard.yaw, share);
        pitch = std::lerp(pitch, heard.pitch, share);
        weight = std::lerp(weight, 1.0, share);
        if (share > 0.0) at = heard.at;
    }
    if (weight <= 0.0) return {};
    return {static_cast<float>(yaw / weight), static_cast<float>(pitch / weight), static_cast<float>(weight),
            static_cast<float>(at)};
}

}  // namespace throng::recording
