// SPDX-License-Identifier: Apache-2.0
#include "recording/attention.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/frame.h"
#include "base/random.h"
#include "recording/heads.h"
#include "recording/spring.h"

namespace throng::recording {
namespace {

using std::numbers::pi;

constexpr double kMostRate = 1.4;                   // rad/s: so fast targets are followed, and no faster
constexpr float kTracks = 8.0f;                     // 1/s: how soon it is seen how fast a target goes
constexpr double kForeseen = 0.4;                   // s: how far ahead it is reckoned where a target goes
constexpr double kFastest = 190.0 * kDegrees;       // per second, on the chest
constexpr double kBehind = 150.0 * kDegrees;        // to either side
constexpr double kSettles = 0.28;                   // s: so far behind its target a head is that follows it
constexpr float kAttends = 7.0f, kLetsGo = 4.0f;    // 1/s, of the weight
constexpr double kStraight = 0.03, kTurned = 0.15;  // rad: heads go as they would, and do not

double directionOf(const Onlooker& self) {
    return std::atan2(self.heading.y, self.heading.x) + self.twist;
}

/// Low ones are looked over.
std::vector<authoring::Wall> high(std::vector<authoring::Wall> walls, std::vector<glm::dvec2>& along) {
    std::vector<authoring::Wall> kept;
    std::vector<glm::dvec2> kept_along;
    for (std::size_t i = 0; i < walls.size(); ++i) {
        if (walls[i].height < authoring::kSeenOver) continue;
        kept.push_back(std::move(walls[i]));
        if (!along.empty()) kept_along.push_back(along[i]);
    }
    along = std::move(kept_along);
    return kept;
}

}  // namespace

AttentionTrack::AttentionTrack(std::size_t rows, double fps, std::uint64_t seed, Site site)
    : interval_(1.0 / fps),
      seed_(seed),
      things_(std::move(site.things)),
      heads_(rows),
      walls_(high(std::move(site.walls), site.along_walls), site.minimum, site.maximum, site.along_walls),
      grid_(site.minimum, site.maximum, kNoticed / 2.0, cellsFor(rows)),
      company_(seed),
      index_(rows, kNone) {
    for (std::uint32_t i = 0; i < things_.size(); ++i)
        if (things_[i].loud) sounds_.push_back(i);
    std::ranges::stable_sort(sounds_, {}, [this](std::uint32_t i) { return things_[i].from; });
}

Attention AttentionTrack::operator[](std::size_t row) const {
    const Head& head = heads_[row];
    const auto yaw =
        static_cast<float>(std::remainder(double{head.yaw.angle} - double{head.chest}, 2.0 * pi));
    int at = 0;
    switch (head.target) {
        case Target::aside:
            break;
        case Target::way:
            at = kLooksAhead;
            break;
        case Target::thing:
        case Target::sound:
            at = kFirstThing - static_cast<int>(head.at);
            break;
        default:
            at = static_cast<int>(head.at) + 1;
    }
    return {yaw, head.pitch.angle, std::clamp(head.weight, 0.0f, 1.0f), static_cast<float>(at)};
}

void AttentionTrack::look(std::span<const Onlooker> people, std::uint32_t frame) {
    people_ = people;
    frame_ = frame;
    time_ = frame * interval_;
    std::ranges::fill(index_, kNone);
    places_.clear();
    for (const Onlooker& each : people) {
        index_[each.row] = static_cast<std::uint32_t>(places_.size());
        places_.push_back(each.place);
    }
    grid_.sort(places_);
    walls_.look(time_ - interval_, time_);
    company_.gather(people, grid_);
    for (std::uint32_t i = 0; i < people.size(); ++i)
        decide(i);
    for (const Onlooker& self : people)
        follow(self);
    people_ = {};
}

const Onlooker* AttentionTrack::personAt(const Head& head) const {
    const bool is_person =
        head.target == Target::company || head.target == Target::passer || head.target == Target::other;
    return is_person && index_[head.at] != kNone ? &people_[index_[head.at]] : nullptr;
}

/// Where somebody's target is, as far as heads go there.
AttentionTrack::Aim AttentionTrack::aimOf(const Onlooker& self) const {
    const Head& head = heads_[self.row];
    Aim aim{-self.twist, 0.0};  // ahead is where the hips point
    if (const Onlooker* other = personAt(head)) {
        aim.yaw = angleTo(self, other->place) - self.twist;
        aim.pitch = std::atan2(other->height - self.height, glm::distance(self.place, other->place));
    } else if (head.target == Target::thing || head.target == Target::sound) {
        const EyeCatcher& thing = things_[head.at];
        aim.yaw = angleTo(self, thing.place) - self.twist;
        aim.pitch = std::atan2(thing.height - self.height - kEyes, glm::distance(self.place, thing.place));
    } else if (head.target == Target::aside) {
        aim = {double{head.aside}, double{head.up}};
    } else {
        aim.yaw += std::clamp(self.turns, -kMostLead, kMostLead);
    }
    if (head.target != Target::way) liven(self, aim);
    // What is right behind stays on the side on which it is looked for.
    aim.yaw = std::remainder(aim.yaw, 2.0 * pi);
    if (std::abs(aim.yaw) > kBehind)
        aim.yaw =
            std::copysign(aim.yaw, std::remainder(double{head.yaw.angle} - double{head.chest}, 2.0 * pi));
    aim.yaw = std::clamp(head.share * aim.yaw, -kMostYaw, kMostYaw);
    aim.pitch = std::clamp(head.share * aim.pitch, -kMostPitch, kMostPitch);
    return aim;
}

/// Nobody holds the head quite still; who speaks moves it with what it says.
void AttentionTrack::liven(const Onlooker& self, Aim& aim) const {
    const bool speaks = heads_[self.row].speaks > 0 && heads_[self.row].target == Target::company;
    const double size = (speaks ? 2.6 : 1.0) * kDegrees, pace = speaks ? 2.2 : 1.0;
    const std::uint64_t word = scramble(seed_ ^ scramble(self.row) ^ 0x6c697665u);
    const auto wave = [&](int which, double seconds) {
        const double off = static_cast<double>((word >> (16 * which)) & 0xffffu) / 65536.0;
        return std::sin(2.0 * pi * (time_ * pace / (seconds + off) + off));
    };
    aim.yaw += size * (0.7 * wave(0, 2.3) + 0.5 * wave(1, 4.1));
    aim.pitch += size * (0.5 * wave(2, 1.9) + 0.4 * wave(3, 3.2));
}

/// The first frame of somebody: its head is straight.
void AttentionTrack::enter(Head& head, const Onlooker& self) {
    const auto chest = static_cast<float>(directionOf(self));
    head.chest = head.yaw.angle = head.aim = chest;
    head.known = 1;
    while (head.heard < sounds_.size() && things_[sounds_[head.heard]].from < time_ - interval_)
        ++head.heard;
    head.rests = static_cast<float>(between(self.row, 0.0, 1.5));
}

/// The yaw of a head on its chest, brought within limits.
/// @param rate rad/s, of the chest
double AttentionTrack::keepWithin(Head& head, double chest, double rate, double least, double most) {
    const double yaw = std::remainder(double{head.yaw.angle} - chest, 2.0 * pi);
    const double kept = std::clamp(yaw, least, most);
    if (kept != yaw) {
        head.yaw.rate = static_cast<float>(rate);
        head.yaw.acceleration = 0.0f;
    }
    head.yaw.angle = static_cast<float>(chest + kept);
    return kept;
}

/// Heads keep still in space while the chest turns under them, as far as necks reach.
void AttentionTrack::follow(const Onlooker& self) {
    Head& head = heads_[self.row];
    const double chest = directionOf(self);
    const double rate = std::remainder(chest - double{head.chest}, 2.0 * pi) / interval_;
    const double before_yaw = std::remainder(double{head.yaw.angle} - double{head.chest}, 2.0 * pi);
    const double yaw = keepWithin(head, chest, rate, -kMostYaw, kMostYaw);
    const Aim aim = aimOf(self);
    if (head.settles == kAtOnce) {
        const double away = std::hypot(aim.yaw - yaw, aim.pitch - double{head.pitch.angle});
        head.settles = static_cast<float>(secondsToTurn(away));
        head.aim_rate = 0.0f;
    } else {
        const double before = std::remainder(double{head.aim} - chest, 2.0 * pi);
        const double goes = std::clamp((aim.yaw - before) / interval_, -kMostRate, kMostRate);
        head.aim_rate +=
            static_cast<float>((goes - double{head.aim_rate}) * (1.0 - std::exp(-kTracks * interval_)));
    }
    head.aim = static_cast<float>(chest + aim.yaw);
    head.chest = static_cast<float>(chest);
    const double left = std::max(double{head.settles}, kSettles);
    turnTowards(head.yaw, chest + aim.yaw, double{head.aim_rate} * std::min(1.0, kForeseen / left), left,
                interval_);
    turnTowards(head.pitch, aim.pitch, 0.0, left, interval_);
    head.pitch.angle =
        std::clamp(head.pitch.angle, static_cast<float>(-kMostPitch), static_cast<float>(kMostPitch));
    head.settles = std::max(head.settles - static_cast<float>(interval_), 0.0f);
    // A chest that turns faster than necks do takes the head along.
    const double reach = kFastest * interval_;
    weigh(head, self,
          keepWithin(head, chest, rate, std::max(-kMostYaw, before_yaw - reach),
                     std::min(kMostYaw, before_yaw + reach)));
}

/// Who minds the way, and does not turn, has nothing to turn the head for.
void AttentionTrack::weigh(Head& head, const Onlooker& self, double yaw) {
    const double ahead = yaw + self.twist;
    const double turned =
        std::max({std::abs(ahead), std::abs(self.turns), std::abs(double{head.pitch.angle})});
    const double wanted = head.target == Target::way ? easedFrom(turned, kStraight, kTurned) : 1.0;
    approach(head.weight, head.weight_rate, static_cast<float>(wanted),
             wanted > double{head.weight} ? kAttends : kLetsGo, static_cast<float>(interval_));
}

}  // namespace throng::recording
