// SPDX-License-Identifier: Apache-2.0
// What people look at next. Sources: docs/how-to/attention.md.
#include <algorithm>
#include <cmath>

#include "base/frame.h"
#include "base/random.h"
#include "base/storeys.h"
#include "recording/attention.h"
#include "recording/heads.h"

namespace throng::recording {
namespace {

constexpr double kLost = 9.0;  // m: others are looked at up to here

constexpr double kListens = 0.88, kAddresses = 0.77;  // Vertegaal et al. 2001
constexpr double kTalkReach = 3.0;                    // m

constexpr double kSoon = 2.0;                  // s, until somebody crosses
constexpr double kClose = 1.5;                 // m, at the nearest
constexpr double kClosing = 0.5;               // m/s
constexpr double kLooksUp = 0.86;              // Fotios, Uttley and Yang 2015
constexpr double kGlance = 0.7;                // of the way that heads go where eyes alone would do
constexpr std::uint32_t kEvery = 3;            // frames, between looks for passers
constexpr double kTooFast = 100.0 * kDegrees;  // per second: who goes by so fast is let go

constexpr double kTurns = 10.0 * kDegrees;  // ahead: whoever turns more minds the way

constexpr double kOneself = 0.6;  // m: nearer than that, one is it
constexpr double kComes = 0.5, kOther = 0.2, kMostOthers = 0.7;
constexpr double kOncoming = -0.3;  // cosine between headings

}  // namespace

/// Draws one of several by their weights, one after the other, and keeps none but the one that is ahead.
struct AttentionTrack::Draw {
    double chance;  ///< 0 to 1, of this draw
    double total = 0.0;
    Target target = Target::way;
    std::uint32_t at = 0;

    void offer(double weight, Target what, std::uint32_t which = 0) {
        if (weight <= 0.0) return;
        total += weight;
        const double share = weight / total;
        if (chance < share) {
            target = what;
            at = which;
            chance /= share;
        } else {
            chance = (chance - share) / (1.0 - share);
        }
    }
};

/// From 0 to 1.
double AttentionTrack::draw(std::uint32_t row) {
    return fractionOf(scramble(scramble(seed_ ^ scramble(row)) + heads_[row].draws++));
}

void AttentionTrack::turnTo(const Onlooker& self, Target target, std::uint32_t at, double seconds,
                            double share) {
    Head& head = heads_[self.row];
    head.target = target;
    head.at = at;
    head.left = static_cast<float>(seconds);
    head.share = static_cast<float>(share);
    head.settles = kAtOnce;
}

/// What is in a wall, as a shop window is, is seen from before it.
bool AttentionTrack::seesThing(const Onlooker& self, glm::dvec2 place) const {
    constexpr double kBefore = 0.5;  // m
    const double away = glm::distance(self.place, place);
    return away <= kBefore || sees(self, glm::mix(place, self.place, kBefore / away));
}

bool AttentionTrack::sees(const Onlooker& self, glm::dvec2 place) const {
    if (walls_.empty()) return true;
    walls_.standAt(self.height);
    return !walls_.crosses(self.place, place);
}

void AttentionTrack::decide(std::uint32_t index) {
    const Onlooker& self = people_[index];
    Head& head = heads_[self.row];
    if (head.known == 0) enter(head, self);
    head.left -= static_cast<float>(interval_);
    head.rests -= static_cast<float>(interval_);
    if (hear(self) || (head.target == Target::sound && head.left > 0.0f)) return;
    listen(index);
    if (notice(index)) return;
    minds(self);
    if (head.left <= 0.0f || isLost(self)) choose(index);
}

/// Turns to a sound after the time of a reaction.
bool AttentionTrack::hear(const Onlooker& self) {
    Head& head = heads_[self.row];
    if (head.heard >= sounds_.size()) return false;
    const std::uint32_t thing = sounds_[head.heard];
    const std::uint64_t word = scramble(seed_ ^ scramble((std::uint64_t{thing} << 32) | self.row));
    const double reaction = 0.2 + 0.3 * fractionOf(word);
    if (time_ < things_[thing].from + reaction) return false;
    ++head.heard;
    if (glm::distance(self.place, things_[thing].place) > things_[thing].reach) return false;
    const bool is_behind = std::abs(angleTo(self, things_[thing].place)) > kField;
    turnTo(self, Target::sound, thing,
           is_behind && !self.stands() ? between(self.row, 0.8, 1.4) : between(self.row, 1.5, 3.5));
    return true;
}

bool AttentionTrack::isTalking(std::uint32_t index) const {
    const Onlooker& self = people_[index];
    if (!self.stands() || self.has_subject) return false;
    return std::ranges::any_of(company_.of(index), [&](std::uint32_t other) {
        return other != index && people_[other].stands() &&
               glm::distance(self.place, people_[other].place) < kTalkReach &&
               areOnOneGround(self.height, people_[other].height) && sees(self, people_[other].place);
    });
}

/// Who listens looks up when somebody else begins to speak.
void AttentionTrack::listen(std::uint32_t index) {
    const Onlooker& self = people_[index];
    Head& head = heads_[self.row];
    head.speaks = 0;
    if (company_.of(index).empty() || !isTalking(index)) return;
    const Company::Turn turn = company_.turnAt(index, people_, time_);
    head.speaks = turn.speaker == index ? 1 : 0;
    if (turn.number == head.turn) return;
    head.turn = turn.number;
    head.left = std::min(head.left, static_cast<float>(between(self.row, 0.15, 0.5)));
}

/// Looks at somebody who is about to cross close by.
bool AttentionTrack::notice(std::uint32_t index) {
    const Onlooker& self = people_[index];
    Head& head = heads_[self.row];
    if (head.rests > 0.0f || frame_ % kEvery != self.row % kEvery || head.target == Target::passer)
        return false;
    std::uint32_t found = kNone;
    double soonest = kSoon;
    const glm::dvec2 own = self.speed * self.heading;
    grid_.near(self.place, kNoticed, [&](std::uint32_t i) {
        const Onlooker& other = people_[i];
        if (i == index || other.party == self.party) return;
        const glm::dvec2 away = other.place - self.place, goes = other.speed * other.heading - own;
        const double square = glm::dot(goes, goes), towards = -glm::dot(away, goes);
        if (square < kClosing * kClosing || towards <= 0.0 || towards > soonest * square) return;
        if (glm::length(away + (towards / square) * goes) > kClose) return;
        if (!areOnOneGround(self.height, other.height) || !isBefore(self, other.place, kNoticed, kField))
            return;
        soonest = towards / square;
        found = i;
    });
    if (found == kNone) return false;
    const bool is_busy = isTalking(index);
    head.rests = static_cast<float>(is_busy ? between(self.row, 4.0, 10.0) : between(self.row, 1.8, 4.5));
    if (draw(self.row) > (is_busy ? 0.5 * kLooksUp : kLooksUp) || !sees(self, people_[found].place))
        return false;
    turnTo(self, Target::passer, people_[found].row, between(self.row, 0.5, 0.9), kGlance);
    return true;
}

/// Whoever is about to turn looks there first.
void AttentionTrack::minds(const Onlooker& self) {
    const Head& head = heads_[self.row];
    if (head.target == Target::way || head.target == Target::passer || self.stands()) return;
    if (std::abs(self.turns) > kTurns) turnTo(self, Target::way, 0, between(self.row, 0.6, 1.4));
}

/// Whether a target has gone, or has passed by.
bool AttentionTrack::isLost(const Onlooker& self) const {
    const Head& head = heads_[self.row];
    if (head.target == Target::thing) {
        const EyeCatcher& thing = things_[head.at];
        return time_ > thing.until || !isBefore(self, thing.place, 1.2 * thing.reach, kField);
    }
    if (head.target == Target::way || head.target == Target::aside || head.target == Target::sound)
        return false;
    const Onlooker* other = personAt(head);
    if (!other || !isBefore(self, other->place, kLost, kField)) return true;
    const glm::dvec2 away = other->place - self.place;
    const glm::dvec2 goes = other->speed * other->heading - self.speed * self.heading;
    return std::abs(away.x * goes.y - away.y * goes.x) > kTooFast * glm::dot(away, away);
}

void AttentionTrack::choose(std::uint32_t index) {
    if (isTalking(index))
        talk(index);
    else
        stroll(index);
}

void AttentionTrack::glanceAside(const Onlooker& self, double away_from) {
    Head& head = heads_[self.row];
    const double side = draw(self.row) < 0.5 ? -1.0 : 1.0;
    const double wanted = away_from + side * between(self.row, 0.25, 0.9);
    turnTo(self, Target::aside, 0, self.stands() ? between(self.row, 0.8, 2.2) : between(self.row, 0.4, 1.0));
    head.aside = static_cast<float>(std::clamp(wanted, -0.9 * kMostYaw, 0.9 * kMostYaw));
    head.up = static_cast<float>(between(self.row, -0.2, 0.08));
}

/// Listeners look at who speaks; who speaks looks at one of the others, and now and then at nothing.
void AttentionTrack::talk(std::uint32_t index) {
    const Onlooker& self = people_[index];
    const std::span<const std::uint32_t> members = company_.of(index);
    const Company::Turn turn = company_.turnAt(index, people_, time_);
    const bool speaks = turn.speaker == index;
    const auto step = 1 + static_cast<std::size_t>(draw(self.row) * static_cast<double>(members.size() - 1));
    const auto own = static_cast<std::size_t>(std::ranges::find(members, index) - members.begin());
    const std::uint32_t somebody = members[(own + std::min(step, members.size() - 1)) % members.size()];
    const std::uint32_t faced = speaks ? somebody : turn.speaker;
    const double chance = draw(self.row);
    const bool attends = chance < (speaks ? kAddresses : kListens);
    const std::uint32_t at = attends || chance > 0.96 ? faced : somebody;
    const double angle = angleTo(self, people_[at].place) - self.twist;
    if ((attends || members.size() > 2) && isBefore(self, people_[at].place, kTalkReach, kField) &&
        sees(self, people_[at].place))
        turnTo(self, Target::company, people_[at].row,
               attends ? between(self.row, 1.2, 3.6) : between(self.row, 0.5, 1.4));
    else
        glanceAside(self, std::clamp(angle, -kMostYaw, kMostYaw));
}

/// Anything in sight, by its weight; who has looked at something looks ahead again.
void AttentionTrack::stroll(std::uint32_t index) {
    const Onlooker& self = people_[index];
    Head& head = heads_[self.row];
    const bool stands = self.stands(), was_ahead = head.target == Target::way;
    Draw draws{draw(self.row)};
    draws.offer(self.has_subject ? 2.5 : stands ? 0.8 : was_ahead ? 1.0 : 3.0, Target::way);
    draws.offer(stands ? 0.6 : 0.25, Target::aside);
    drawPeople(index, draws);
    drawThings(self, draws);
    switch (draws.target) {
        case Target::aside:
            return glanceAside(self);
        case Target::thing:
            if (!seesThing(self, things_[draws.at].place)) break;
            return turnTo(self, Target::thing, draws.at,
                          stands ? between(self.row, 2.0, 7.0) : between(self.row, 0.9, 2.6));
        case Target::company:
            if (!sees(self, people_[index_[draws.at]].place)) break;
            return turnTo(self, Target::company, draws.at, between(self.row, 0.8, stands ? 3.5 : 2.2));
        case Target::other:
            if (!sees(self, people_[index_[draws.at]].place)) break;
            return turnTo(self, Target::other, draws.at, between(self.row, 0.4, stands ? 1.6 : 0.9), kGlance);
        default:
            break;
    }
    turnTo(self, Target::way, 0, between(self.row, 0.8, stands ? 3.0 : 2.6));
}

void AttentionTrack::drawPeople(std::uint32_t index, Draw& draw) const {
    const Onlooker& self = people_[index];
    const Head& head = heads_[self.row];
    const Onlooker* before = personAt(head);
    const std::span<const std::uint32_t> company = company_.of(index);
    double others = 0.0;
    const auto fades = [&](const Onlooker& other) {
        return 1.0 - glm::distance(self.place, other.place) / (kNoticed + 1.0);
    };
    for (const std::uint32_t i : company) {
        const Onlooker& other = people_[i];
        if (i == index || &other == before || !isBefore(self, other.place, kNoticed, kField)) continue;
        const bool speaks = company_.turnAt(index, people_, time_).speaker == i;
        draw.offer((speaks ? 1.2 : 0.6) * fades(other), Target::company, other.row);
    }
    grid_.near(self.place, kNoticed, [&](std::uint32_t i) {
        const Onlooker& other = people_[i];
        if (i == index || &other == before || other.party == self.party || others > kMostOthers ||
            !isBefore(self, other.place, kNoticed, kField) || !areOnOneGround(self.height, other.height))
            return;
        const bool comes = !other.stands() && glm::dot(self.heading, other.heading) < kOncoming;
        const double weight = (comes ? kComes : kOther) * fades(other);
        others += weight;
        draw.offer(weight, Target::other, other.row);
    });
}

void AttentionTrack::drawThings(const Onlooker& self, Draw& draw) const {
    const Head& head = heads_[self.row];
    for (std::uint32_t i = 0; i < things_.size(); ++i) {
        const EyeCatcher& thing = things_[i];
        if (time_ < thing.from || time_ > thing.until || !isBefore(self, thing.place, thing.reach, kField))
            continue;
        if (glm::distance(self.place, thing.place) < kOneself) continue;
        if (thing.storey && !areOnOneGround(self.height, *thing.storey)) continue;
        const bool was = (head.target == Target::thing || head.target == Target::sound) && head.at == i;
        const double near = 1.0 - glm::distance(self.place, thing.place) / (1.2 * thing.reach);
        draw.offer(thing.weight * near * (was && !self.stands() ? 0.3 : 1.0), Target::thing, i);
    }
}

}  // namespace throng::recording
