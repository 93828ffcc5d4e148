// SPDX-License-Identifier: Apache-2.0
#include "recording/footsteps.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "recording/carriages.h"
#include "recording/spring.h"

namespace throng::recording {
namespace {

using std::numbers::pi_v;

// Feet as blender_addon/throng/cast/gait.py has them, shares of a foot's own cycle.
constexpr double kRunningStride = 2.1;               // m: longer ones are run
constexpr double kRunsDown = 0.15, kRunsFor = 0.33;  // comes down, is down for
constexpr double kDownFor = 0.62, kLessDown = 0.09;  // at that stride; less for each time that it is longer
constexpr float kBeside = 0.06f;                     // m, of a foot from the middle

constexpr float kSwingsFrom = 0.3f;  // share of walking: below it, feet stay down but for steps of their own
constexpr float kLegStiffness = 11.0f;  // 1/s, of what brings a foot in the air back to the clip's
constexpr float kStepTime = 0.4f;       // s
constexpr float kQuickStepTime = 0.28f, kQuick = 1.5f;  // s; rad/s: of who spins so fast or faster
constexpr float kStepsAt = 0.14f;      // m: who stands makes a step at that distance from the clip's foot
constexpr float kStepsAtTurn = 0.55f;  // rad: or if turned by that
constexpr float kSettlesAt = 0.06f, kSettlesAtTurn = 0.25f;  // who has stood for a while puts its feet right
constexpr float kSettlesAfter = 0.7f;                        // s
constexpr float kLongest = 0.35f, kLongestTurn = 0.9f;       // a foot that walks leaves the ground at that
constexpr float kLegReach = 0.45f,
                kLegReachTurned = 1.0f;  // m, rad: as far as legs go; then a foot is dragged
constexpr float kUrgent = 1.2f,
                kUrgentAtRest =
                    1.8f;  // a foot that is so much too far goes while the other one is in the air
constexpr float kMostAhead = 0.22f, kMostTurnAhead = 0.35f;  // m, rad: how much ahead feet come down
constexpr float kLeastLift = 0.02f, kMostLift = 0.06f, kLiftPerMetre = 0.25f, kLiftPerRadian = 0.03f;  // m

glm::vec2 leftOf(glm::vec2 heading) {
    return {-heading.y, heading.x};
}

float wrapped(float angle) {
    return std::remainder(angle, 2.0f * pi_v<float>);
}

glm::vec2 atMost(glm::vec2 vector, float length) {
    const float own = glm::length(vector);
    return own > length ? vector * (length / own) : vector;
}

/// One stride's foot: when it is down, and where it is ahead of the body, m.
struct ClipFoot {
    explicit ClipFoot(std::uint32_t gait)
        : stride(strideOf(gait)),
          down(stride >= kRunningStride ? kRunsDown : 0.0),
          down_for(stride >= kRunningStride ? kRunsFor
                                            : kDownFor - kLessDown * (stride / kNormalStride - 1.0)) {}

    double since(double phase) const { return phase - down - std::floor(phase - down); }
    bool isDown(double phase) const { return since(phase) < down_for; }
    double ahead(double phase) const {
        const double at = since(phase);
        if (at < down_for) return stride * (kUnderBody - down - at);
        const double share = (at - down_for) / (1.0 - down_for);
        return stride * (kUnderBody - down - down_for * (1.0 - eased(share)));
    }

    double stride, down, down_for;
};

}  // namespace

float turnAndLift(const FootMove& move) {
    return std::round(move.turn * kTurnSteps) + std::clamp(move.lift, 0.0f, 0.999f);
}

FootMove footMoveOf(std::span<const float, 3> values) {
    const float steps = std::floor(values[2]);
    return {values[0], values[1], steps / kTurnSteps, values[2] - steps};
}

/// What both feet of somebody depend on in a frame.
struct Footsteps::Moment {
    glm::vec2 heading{1.0f, 0.0f};
    float direction = 0.0f, turns = 0.0f;  ///< rad, rad/s
    float walking = 0.0f;                  ///< share of it
    bool rests = false;
    std::array<glm::vec2, 2> clip{};     ///< m: where the clip has the feet
    std::array<bool, 2> down{};          ///< whether the clip's are
    std::array<glm::vec2, 2> carries{};  ///< m: how far they come as standing goes over into walking
    glm::vec2 slides{0.0f};              ///< m/s, that a planted foot of the clip would slide
    float stands_for = 0.0f;             ///< s, that a foot is down in a cycle
};

Footsteps::Footsteps(std::size_t rows, double fps)
    : interval_(static_cast<float>(1.0 / fps)), people_(rows) {}

std::array<FootMove, 2> Footsteps::step(std::size_t row, const Walker& walker, const GaitTrack& gait) {
    Person& person = people_[row];
    Moment now;
    now.heading = walker.heading;
    now.direction = std::atan2(walker.heading.y, walker.heading.x);
    now.walking = walker.walking;
    now.rests = walker.speed < static_cast<float>(kStandsBelow);
    const ClipFoot stride(gait.gait), before(gait.before);
    const double old = eased(gait.left());
    for (const std::size_t side : {0u, 1u}) {
        const double phase = gait.phase + (side == 0 ? 0.5 : 0.0);
        const auto ahead = static_cast<float>(glm::mix(stride.ahead(phase), before.ahead(phase), old));
        now.clip[side] =
            walker.place + walker.scale * (now.walking * ahead * walker.heading +
                                           (side == 0 ? kBeside : -kBeside) * leftOf(walker.heading));
        now.down[side] = stride.isDown(phase);
        now.carries[side] = walker.scale * ahead * (person.walking - now.walking) * walker.heading;
    }
    const bool is_new = person.known == 0;
    if (!is_new) now.turns = wrapped(now.direction - person.direction) / interval_;
    now.slides = walker.moved / interval_ - now.walking * walker.speed * walker.scale * walker.heading;
    now.stands_for = static_cast<float>(stride.down_for * stride.stride) / std::max(walker.speed, 0.3f);
    person.direction = now.direction;
    person.walking = now.walking;
    person.known = 1;

    for (Foot& foot : person.feet)
        foot.anchor += walker.carried;
    std::array<FootMove, 2> moves;
    if (!is_new) lift(person, now);
    for (const std::size_t side : {0u, 1u}) {
        Foot& foot = person.feet[side];
        if (is_new) {
            foot.anchor = now.clip[side];
            foot.facing = now.direction;
            foot.contact = now.walking > kSwingsFrom && !now.down[side] ? Contact::swings : Contact::planted;
        }
        move(foot, now, side);
        const float up =
            foot.contact == Contact::steps
                ? foot.height *
                      std::max(0.0f, std::sin(pi_v<float> * std::min(foot.since / foot.lasts, 1.0f)))
                : 0.0f;
        moves[side] = {glm::dot(foot.away, now.heading), glm::dot(foot.away, leftOf(now.heading)), foot.turn,
                       up};
    }
    return moves;
}

/// Lets feet leave the ground: those that swing in the clip, and of the others the one that has most need to.
void Footsteps::lift(Person& person, const Moment& now) const {
    const auto goes = [&now](Foot& foot, Contact how) {
        foot.contact = how;
        foot.since = 0.0f;
        foot.rate = {};
        foot.turn_rate = 0.0f;
        foot.lasts = glm::mix(kStepTime, kQuickStepTime, std::min(std::abs(now.turns) / kQuick, 1.0f));
        foot.height =
            std::clamp(kLiftPerMetre * glm::length(foot.away) + kLiftPerRadian * std::abs(foot.turn),
                       kLeastLift, kMostLift);
    };
    const bool swings = now.walking > kSwingsFrom;
    std::array<float, 2> need{};  // 1: that of a foot that has to go
    for (const std::size_t side : {0u, 1u}) {
        Foot& foot = person.feet[side];
        if (foot.contact != Contact::planted) continue;
        if (swings && !now.down[side]) {
            goes(foot, Contact::swings);
            continue;
        }
        const float far = glm::distance(foot.anchor, now.clip[side]);
        const float turned = std::abs(wrapped(foot.facing - now.direction));
        need[side] = swings ? std::max(far / kLongest, turned / kLongestTurn)
                            : std::max(far / kStepsAt, turned / kStepsAtTurn);
        if (now.rests && foot.since > kSettlesAfter && (far > kSettlesAt || turned > kSettlesAtTurn))
            need[side] = std::max(need[side], 1.0f);
    }
    const std::size_t side = need[1] > need[0] ? 1 : 0;
    const Foot& other = person.feet[1 - side];
    if (need[side] >= 1.0f &&
        (other.contact == Contact::planted || need[side] >= (swings ? kUrgent : kUrgentAtRest)))
        goes(person.feet[side], Contact::steps);
}

void Footsteps::move(Foot& foot, const Moment& now, std::size_t side) const {
    foot.since += interval_;
    if (foot.contact == Contact::planted) {
        foot.away = atMost(foot.anchor - now.clip[side], kLegReach);
        foot.turn = std::clamp(wrapped(foot.facing - now.direction), -kLegReachTurned, kLegReachTurned);
        foot.anchor = now.clip[side] + foot.away;
        foot.facing = now.direction + foot.turn;
        return;
    }
    foot.away += now.carries[side];  // which is no swing: the foot stays where it is, and follows
    const float half = 0.5f * now.stands_for;
    approach(foot.away, foot.rate, atMost(half * now.slides, kMostAhead), kLegStiffness, interval_);
    approach(foot.turn, foot.turn_rate, std::clamp(half * now.turns, -kMostTurnAhead, kMostTurnAhead),
             kLegStiffness, interval_);
    const bool swings = now.walking > kSwingsFrom && !now.down[side];
    const bool comes_down = foot.contact == Contact::steps ? foot.since >= foot.lasts && !swings : !swings;
    if (!comes_down) return;
    foot.contact = Contact::planted;
    foot.since = 0.0f;
    foot.anchor = now.clip[side] + foot.away;
    foot.facing = now.direction + foot.turn;
}

}  // namespace throng::recording
