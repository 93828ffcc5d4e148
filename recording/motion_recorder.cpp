// SPDX-License-Identifier: Apache-2.0
#include "recording/motion_recorder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "base/lift_track.h"
#include "base/random.h"
#include "base/wide_site.h"
#include "shaders/shared/chart_types.h"
#include "shaders/shared/scene_types.h"

namespace throng::recording {
namespace {

const double kPerMetre = double{gpu::PLACES_PER_METRE};
constexpr auto kLed = static_cast<float>(gpu::ACTIVITY_LED);

/// Whether somebody is led between rows of seats. @param at where its state begins
bool isLed(std::span<const float> states, std::size_t at) {
    return states[at] >= kLed;
}

/// The walls in the frame of reference of the frames, as finely as the simulation has them: a layout that is
/// moved by whole metres then has the very same.
std::vector<authoring::Wall> localWalls(const BakeDescription& description) {
    std::vector<authoring::Wall> walls = description.walls;
    for (authoring::Wall& wall : walls)
        for (glm::dvec2& point : wall.points)
            point = glm::round((point - description.scene_origin) * kPerMetre) / kPerMetre;
    return walls;
}

/// Which storey a wall is on, where there are several.
std::vector<glm::dvec2> groundAlongWalls(const BakeDescription& description) {
    return description.charts && description.terrain ? description.terrain->along_walls
                                                     : std::vector<glm::dvec2>{};
}

bool hasHeads(const BakeDescription& description) {
    return description.asked[Stream::gaze] || description.asked[Stream::attention];
}

AttentionTrack::Site siteOf(const BakeDescription& description) {
    return {description.minimum - description.scene_origin, description.maximum - description.scene_origin,
            localWalls(description), groundAlongWalls(description), description.eye_catchers};
}

}  // namespace

MotionRecorder::MotionRecorder(const BakeDescription& description, Sink sink)
    : fps_(description.fps),
      wide_(isWideSite(description.minimum - description.scene_origin,
                       description.maximum - description.scene_origin)),
      sink_(std::move(sink)),
      window_(description.smoothing, description.fps,
              hasHeads(description) ? AttentionTrack::kForesees : 0.0),
      apart_(localWalls(description), description.minimum - description.scene_origin,
             description.maximum - description.scene_origin, groundAlongWalls(description)),
      walkers_(description.agents.size()),
      carried_(fromDevice(description.asked)) {
    if (description.charts) {
        shifts_ = description.charts->shifts;
        for (const glm::dvec2 velocity : description.charts->belts)
            belts_.push_back(velocity / fps_);
        charts_.resize(walkers_.size());
        cabins_ = description.charts->cabins;
        lift_count_ = description.lifts.size();
    }
    if (description.has_poses) {
        poses_.resize(walkers_.size());
        led_.resize(walkers_.size());
        leading_.resize(walkers_.size());
        for (std::size_t row = 0; row < walkers_.size(); ++row)
            paces_.push_back(fractionOf(scramble(description.seed ^ scramble(row ^ wordOf("poses")))));
    }
    if (!description.sitters.empty()) cues_.resize(walkers_.size());
    for (const BakeSitter& sitter : description.sitters)
        cues_[sitter.row] = sitter.cues;
    if (description.terrain) {
        ground_ = description.terrain->surface;
        footing_.emplace(ground_, walkers_.size(), fps_);
        grounds_.resize(walkers_.size() * kComponents);
        for (const BakeSeats& seats : description.seats)
            for (const BakeAisle& aisle : seats.aisles)
                if (!aisle.heights.empty() && shifts_.empty())
                    aisle_feet_.emplace_back(aisle.line.front() - description.scene_origin,
                                             aisle.heights.front());
    }
    for (const BakeAgent& agent : description.agents) {
        parties_.push_back(agent.party);
        given_.push_back(agent.group < description.groups.size() && description.groups[agent.group].is_given);
        radii_.push_back(agent.body.isDisc() ? agent.radius : static_cast<float>(agent.body.radius()));
        half_axes_.push_back(static_cast<float>(agent.body.halfAxis()));
        speeds_.push_back(agent.preferred_speed);
        scales_.push_back(static_cast<float>(agent.scale));
    }
    const glm::dvec2 minimum = description.minimum - description.scene_origin;
    const glm::dvec2 maximum = description.maximum - description.scene_origin;
    if (description.asked[Stream::left_foot]) {
        footsteps_.emplace(walkers_.size(), fps_);
        carriages_.emplace(radii_, fps_, minimum, maximum);
        for (std::vector<float>* values : {&feet_[0], &feet_[1], &carriage_values_})
            values->resize(walkers_.size() * kComponents);
    }
    if (hasHeads(description)) {
        attention_.emplace(walkers_.size(), fps_, description.seed, siteOf(description));
        if (description.asked[Stream::gaze]) gaze_values_.resize(walkers_.size() * kComponents);
        if (description.asked[Stream::attention]) attention_values_.resize(walkers_.size() * kComponents);
    }
}

void MotionRecorder::take(const Frame& frame) {
    if (frame.index != taken_) throw std::invalid_argument("frames come in order");
    ++taken_;
    if (shifts_.empty()) {
        window_.push(frame);
    } else {
        goHome(frame);
        Frame at_home = frame;
        at_home[Stream::pos] = homes_;
        window_.push(at_home);
    }
    while (window_.isReady())
        giveOut();
}

/// Who walks over a seam moves from one part of the plane to another, but nowhere at home.
void MotionRecorder::goHome(const Frame& frame) {
    homes_.assign(frame[Stream::pos].begin(), frame[Stream::pos].end());
    for (std::size_t at = 0; at < homes_.size(); at += kComponents) {
        if (isLed(frame[Stream::state], at)) continue;  // it is at home, and at a height
        const auto chart = static_cast<std::size_t>(homes_[at + 2]);
        if (chart >= shifts_.size()) continue;
        homes_[at] -= static_cast<float>(shifts_[chart].x);
        homes_[at + 1] -= static_cast<float>(shifts_[chart].y);
    }
}

/// From home coordinates to where the frame being given out has somebody in the plane, m.
glm::dvec2 MotionRecorder::toPlane(std::size_t row) const {
    if (shifts_.empty() || charts_[row] >= shifts_.size()) return glm::dvec2(0.0);
    return shifts_[charts_[row]];
}

/// Of the ground under somebody, where floors lie above each other: others there are in its way, and those
/// above are not. m
double MotionRecorder::heightOf(std::size_t row) const {
    if (shifts_.empty() || !ground_) return 0.0;
    const std::size_t at = row * kComponents;
    return double{
               ground_->smoothAt(glm::vec2(glm::dvec2(positions_[at], positions_[at + 1]) + toPlane(row)))} +
           double{liftedBy(row)};
}

/// m: how far the cabin that somebody is in is above the stop at which the plane has it.
float MotionRecorder::liftedBy(std::size_t row) const {
    if (cabins_.empty() || charts_[row] >= cabins_.size()) return 0.0f;
    const BakeCharts::Cabin& cabin = cabins_[charts_[row]];
    const std::size_t at = cabin.lift * kLiftFloats + static_cast<std::size_t>(LiftColumn::height);
    return at < window_.middle().lifts.size() ? window_.middle().lifts[at] - cabin.height : 0.0f;
}

glm::dvec2 MotionRecorder::carriedBy(std::size_t row) const {
    return belts_.empty() || (!led_.empty() && led_[row]) ? glm::dvec2(0.0)
                                                          : window_.averageOfCharts(row, belts_);
}

void MotionRecorder::finish() {
    while (!window_.isEmpty())
        giveOut();
}

void MotionRecorder::giveOut() {
    const KeptFrame& frame = window_.middle();
    positions_ = frame[Stream::pos];
    directions_ = frame[Stream::dir];
    states_ = frame[Stream::state];
    chests_ = frame[Stream::chest];
    for (std::size_t row = 0; row < charts_.size(); ++row)
        charts_[row] =
            isLed(states_, row * kComponents)
                ? gpu::NO_CHART
                : static_cast<std::uint32_t>(std::exchange(positions_[row * kComponents + 2], 0.0f));
    takeOutOfPlane();
    if (window_.reach() > 0) average(frame);
    turnChests(frame);
    record(frame);
    if (carriages_ || attention_) findOnlookers(frame);
    if (carriages_) carry();
    if (attention_) look(frame.index);
    Frame shown = frame.view();
    shown[Stream::pos] = positions_;
    shown[Stream::dir] = directions_;
    shown[Stream::state] = states_;
    shown[Stream::ground] = grounds_;
    shown[Stream::left_foot] = feet_[0];
    shown[Stream::right_foot] = feet_[1];
    shown[Stream::carriage] = carriage_values_;
    shown[Stream::gaze] = gaze_values_;
    shown[Stream::attention] = attention_values_;
    shown[Stream::chest] = chests_;
    sink_(shown);
    window_.advance();
}

/// Who is led between rows of seats says so beside what it does.
void MotionRecorder::takeOutOfPlane() {
    for (std::size_t row = 0; row < led_.size(); ++row) {
        led_[row] = isLed(states_, row * kComponents);
        leading_[row] = 0.0f;
        if (!led_[row]) continue;
        const std::size_t at = row * kComponents;
        states_[at] -= kLed;
        if (states_[at] == static_cast<float>(gpu::ACTIVITY_WALK))
            leading_[row] = std::exchange(states_[at + 2], 0.0f);
    }
}

/// Who steps into an aisle comes from somewhere round its foot, where the ground has another height.
/// @returns m that it is still to be shown above the way for that
float MotionRecorder::overFoot(std::size_t row, glm::vec2 place) const {
    constexpr double kRound = 3.0;  // m
    if (aisle_feet_.empty() || leading_[row] == 0.0f) return 0.0f;
    const auto off = [&](const glm::dvec3& foot) {
        return glm::distance(glm::dvec2(foot), glm::dvec2(place));
    };
    const auto foot = std::ranges::min_element(aisle_feet_, {}, off);
    if (off(*foot) > kRound) return 0.0f;
    return leading_[row] * (ground_->heightAt(place) - static_cast<float>(foot->z));
}

void MotionRecorder::average(const KeptFrame& frame) {
    present_.clear();
    bodies_.clear();
    for (std::uint32_t row = 0; row < walkers_.size(); ++row) {
        if (!frame.isAlive(row)) continue;
        const std::size_t at = row * kComponents;
        const Average average = window_.average(row);
        const bool led = !led_.empty() && led_[row];
        if (!led) present_.push_back(row);
        const glm::dvec2 simulated(positions_[at], positions_[at + 1]);
        const glm::dvec2 shown(average.position[0], average.position[1]);
        if (!led)
            bodies_.push_back({simulated, given_[row] ? simulated : shown, sizeOf(frame, row) * radii_[row],
                               axisOf(frame, row), heightOf(row), given_[row]});
        // On a terrain, heights of those who walk are found later: there is nothing to average those of
        // others with.
        if (shifts_.empty() && !(led && ground_))
            positions_[at + 2] = static_cast<float>(average.position[2]);
        if (led) {
            positions_[at] = static_cast<float>(shown.x);
            positions_[at + 1] = static_cast<float>(shown.y);
        }
        directions_[at] = static_cast<float>(average.heading[0]);
        directions_[at + 1] = static_cast<float>(average.heading[1]);
        directions_[at + 2] = static_cast<float>(average.speed);
    }
    apart_.settle(bodies_, (frame.index - 1.0) / fps_, frame.index / fps_);
    for (std::size_t i = 0; i < present_.size(); ++i) {
        positions_[present_[i] * kComponents] = static_cast<float>(bodies_[i].place.x);
        positions_[present_[i] * kComponents + 1] = static_cast<float>(bodies_[i].place.y);
    }
}

/// How large somebody is, times what it is by itself.
float MotionRecorder::sizeOf(const KeptFrame& frame, std::size_t row) {
    return frame[Stream::size].empty() ? 1.0f : frame[Stream::size][row * kComponents];
}

/// Half of the segment of somebody's body as it was simulated, m; zero of discs.
glm::dvec2 MotionRecorder::axisOf(const KeptFrame& frame, std::size_t row) const {
    if (half_axes_[row] == 0.0f || frame[Stream::chest].empty()) return glm::dvec2(0.0);
    const auto facing = rowOf(std::span(frame[Stream::dir]), row);
    const double angle =
        std::atan2(double{facing[1]}, double{facing[0]}) + double{frame[Stream::chest][row * kComponents]};
    const double size = sizeOf(frame, row);
    return capsuleOf({}, {std::cos(angle), std::sin(angle)}, size * radii_[row], size * half_axes_[row]).axis;
}

/// Chests point where they were simulated to, whichever way the average faces.
void MotionRecorder::turnChests(const KeptFrame& frame) {
    if (chests_.empty() || window_.reach() == 0) return;
    for (std::size_t row = 0; row < walkers_.size(); ++row) {
        if (!frame.isAlive(row) || half_axes_[row] == 0.0f) continue;
        const auto before = rowOf(std::span(frame[Stream::dir]), row);
        const auto after = rowOf(std::span(std::as_const(directions_)), row);
        chests_[row * kComponents] += std::atan2(after[0] * before[1] - after[1] * before[0],
                                                 after[0] * before[0] + after[1] * before[1]);
    }
}

/// Speeds and strides of what is shown.
void MotionRecorder::record(const KeptFrame& frame) {
    for (std::size_t row = 0; row < walkers_.size(); ++row) {
        Walker& walker = walkers_[row];
        const std::size_t at = row * kComponents;
        const glm::vec2 place(positions_[at], positions_[at + 1]);
        if (!frame.isAlive(row)) {
            if (!walker.walks) continue;
            // Who has left stays where it left, with the phase that it left with.
            positions_[at] = walker.place.x;
            positions_[at + 1] = walker.place.y;
            states_[at + 2] = static_cast<float>(walker.gait.phase);
            if (footing_) putStance(at, footing_->last(row));
            if (footsteps_) putFeet(at, {});
            continue;
        }
        // What the ground carries is not walked.
        const glm::vec2 carried = walker.walks ? glm::vec2(carriedBy(row)) : glm::vec2(0.0f);
        const glm::vec2 moved = walker.walks ? place - walker.place - carried : glm::vec2(0.0f);
        if (walker.walks) {
            const double way =
                wide_ ? directions_[at + 2] / fps_
                      : glm::distance(glm::dvec2(walker.place) + glm::dvec2(carried), glm::dvec2(place));
            if (window_.reach() > 0 && !wide_) directions_[at + 2] = static_cast<float>(way * fps_);
            walker.gait.advance(way, 1.0 / fps_);
        } else {
            walker.gait = GaitTrack{phaseAtFirst(row), gaitFor(speeds_[row])};
            walker.walks = 1;
        }
        walker.place = place;
        if (!poses_.empty()) pose(row);
        if (poses_.empty() || !poses_[row].isShown()) {
            states_[at] += walker.gait.inState();
            states_[at + 2] = static_cast<float>(walker.gait.phase);
        }
        const glm::vec2 heading(directions_[at], directions_[at + 1]);
        const float speed = directions_[at + 2];
        if (footsteps_)
            putFeet(at, footsteps_->step(row,
                                         {place, heading, moved, speed, carriages_->step(row, speed),
                                          scales_[row], carried},
                                         walker.gait));
        if (footsteps_ && hasSeat(states_[at])) putFeet(at, {});
        if (footing_ && !led_.empty() && led_[row]) {
            positions_[at + 2] += overFoot(row, place);
            putStance(at, {positions_[at + 2], 0.0f, 0.0f, positions_[at + 2]});
        } else if (footing_) {
            putStance(at,
                      footing_->stand(
                          row, {place + glm::vec2(toPlane(row)), heading, moved, carried != glm::vec2(0.0f)},
                          walker.gait));
        }
        if (footing_) positions_[at + 2] += liftedBy(row);
    }
}

/// Of who sits from the beginning, one of its own: the simulation tells how far up it is.
double MotionRecorder::phaseAtFirst(std::size_t row) const {
    return !led_.empty() && led_[row] ? paces_[row] : double{states_[row * kComponents + 2]};
}

/// What somebody does beside walking and standing. Its gait goes on from where that ends.
void MotionRecorder::pose(std::size_t row) {
    const std::size_t at = row * kComponents;
    PoseTrack& track = poses_[row];
    Walker& walker = walkers_[row];
    PoseWish wish{static_cast<ActivityCode>(static_cast<int>(states_[at])), double{states_[at + 2]},
                  double{directions_[at + 2]}, paces_[row], 1.0 / fps_};
    if (!cues_.empty()) takeCue(row, window_.middle().index / fps_, wish);
    const bool was_shown = track.isShown();
    track.step(wish, walker.gait.phase);
    if (was_shown && !track.isShown()) walker.gait.phase = std::max(walker.gait.phase, track.phase());
    if (!track.isShown()) return;
    states_[at] = static_cast<float>(track.activity());
    states_[at + 2] = static_cast<float>(track.phase());
}

/// Who sits takes part in shows, unless it is about to stand up.
void MotionRecorder::takeCue(std::size_t row, double time, PoseWish& wish) const {
    if (wish.activity != ActivityCode::sits || wish.share < 0.0) return;
    for (const SeatCue& cue : cues_[row]) {
        if (time < cue.at || time >= cue.at + cue.lasts) continue;
        const bool is_wave = cue.activity == ActivityCode::rises;
        const bool begins = time - cue.at < 2.0 / fps_;
        if (is_wave && !begins && poses_[row].activity() != ActivityCode::rises) continue;
        wish.activity = cue.activity;
        wish.lasts = cue.lasts;
        const double into = (time - cue.beat) / kSwaySeconds;
        wish.waits =
            cue.activity == ActivityCode::sings && (into - std::floor(into)) * kSwaySeconds > 1.0 / fps_;
        return;
    }
}

void MotionRecorder::putStance(std::size_t at, const Stance& stance) {
    positions_[at + 2] = stance.height;
    grounds_[at] = stance.along;
    grounds_[at + 1] = stance.across;
    grounds_[at + 2] = stance.ground;
}

void MotionRecorder::putFeet(std::size_t at, const std::array<FootMove, 2>& feet) {
    for (std::size_t side = 0; side < feet.size(); ++side) {
        feet_[side][at] = feet[side].forward;
        feet_[side][at + 1] = feet[side].left;
        feet_[side][at + 2] = turnAndLift(feet[side]);
    }
}

void MotionRecorder::findOnlookers(const KeptFrame& frame) {
    onlookers_.clear();
    for (std::uint32_t row = 0; row < walkers_.size(); ++row) {
        const std::size_t at = row * kComponents;
        if (frame.isAlive(row))
            onlookers_.push_back({row,
                                  parties_[row],
                                  {positions_[at], positions_[at + 1]},
                                  positions_[at + 2],
                                  {directions_[at], directions_[at + 1]},
                                  directions_[at + 2]});
    }
}

/// A stream's values of all who are there; zero of the others.
template <class ValuesOf>
void MotionRecorder::putAll(std::vector<float>& stream, ValuesOf&& of) {
    std::ranges::fill(stream, 0.0f);
    for (const Onlooker& each : onlookers_)
        std::ranges::copy(of(each.row), rowOf(std::span(stream), each.row).begin());
}

void MotionRecorder::carry() {
    carriages_->squeeze(onlookers_);
    putAll(carriage_values_, [this](std::size_t row) {
        if (hasSeat(states_[row * kComponents])) return std::array{0.0f, 0.0f, 0.0f};
        const Carriage carriage = (*carriages_)[row];
        // Who has a body turned its chest in the simulation; the hips take what a spine does not.
        const bool simulated = half_axes_[row] > 0.0f && !chests_.empty();
        const float twist =
            simulated ? std::clamp(chests_[row * kComponents], -kMostTwist, kMostTwist) : carriage.twist;
        return std::array{carriage.walking, twist, carriage.lean};
    });
}

void MotionRecorder::look(std::uint32_t frame) {
    for (Onlooker& each : onlookers_) {
        // The chest is where it is shown.
        each.twist = carriages_ ? double{carriage_values_[each.row * kComponents + 1]} : 0.0;
        const glm::dvec2 to_come = window_.headingToCome(each.row);
        each.turns = std::atan2(each.heading.x * to_come.y - each.heading.y * to_come.x,
                                glm::dot(each.heading, to_come));
        const auto activity = static_cast<ActivityCode>(std::floor(states_[each.row * kComponents]));
        each.has_subject = activity == ActivityCode::looks || activity == ActivityCode::queues;
    }
    attention_->look(onlookers_, frame);
    if (!gaze_values_.empty())
        putAll(gaze_values_, [this](std::size_t row) {
            const Attention head = (*attention_)[row];
            const float twist = carriages_ ? carriage_values_[row * kComponents + 1] : 0.0f;
            return std::array{head.weight * (head.yaw + twist), head.weight * head.pitch, head.at};
        });
    if (!attention_values_.empty())
        putAll(attention_values_, [this](std::size_t row) {
            const Attention head = (*attention_)[row];
            return std::array{head.yaw, head.pitch, head.weight};
        });
}

std::vector<std::byte> MotionRecorder::save() const {
    std::vector<std::byte> bytes(sizeof taken_ + walkers_.size() * sizeof(Walker));
    std::memcpy(bytes.data(), &taken_, sizeof taken_);
    if (!walkers_.empty())
        std::memcpy(bytes.data() + sizeof taken_, walkers_.data(), walkers_.size() * sizeof(Walker));
    if (footing_) bytes.insert(bytes.end(), footing_->state().begin(), footing_->state().end());
    if (footsteps_) bytes.insert(bytes.end(), footsteps_->state().begin(), footsteps_->state().end());
    if (carriages_) bytes.insert(bytes.end(), carriages_->state().begin(), carriages_->state().end());
    if (attention_) bytes.insert(bytes.end(), attention_->state().begin(), attention_->state().end());
    const auto poses = std::as_bytes(std::span(poses_));
    bytes.insert(bytes.end(), poses.begin(), poses.end());
    window_.save(bytes);
    return bytes;
}

void MotionRecorder::restore(std::span<const std::byte> bytes) {
    const std::size_t own = sizeof taken_ + walkers_.size() * sizeof(Walker);
    if (bytes.size() < own) throw std::runtime_error("the checkpoint's motion does not fit this bake");
    std::memcpy(&taken_, bytes.data(), sizeof taken_);
    if (!walkers_.empty()) std::memcpy(walkers_.data(), bytes.data() + sizeof taken_, own - sizeof taken_);
    bytes = bytes.subspan(own);
    const auto take = [&](std::span<std::byte> state) {
        if (bytes.size() < state.size())
            throw std::runtime_error("the checkpoint's motion does not fit this bake");
        std::copy_n(bytes.begin(), state.size(), state.begin());
        bytes = bytes.subspan(state.size());
    };
    if (footing_) take(footing_->state());
    if (footsteps_) take(footsteps_->state());
    if (carriages_) take(carriages_->state());
    if (attention_) take(attention_->state());
    take(std::as_writable_bytes(std::span(poses_)));
    window_.restore(bytes, walkers_.size(), carried_, lift_count_);
}

}  // namespace throng::recording
