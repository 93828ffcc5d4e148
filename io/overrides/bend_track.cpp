// SPDX-License-Identifier: Apache-2.0
#include "io/overrides/bend_track.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "authoring/overrides/bend_curve.h"
#include "recording/carriages.h"
#include "recording/footsteps.h"

namespace throng::io {
namespace {

using authoring::BendCurve;

constexpr double kTurnsFrom = 0.1, kTurnsFully = 0.5;  // m/s: who hardly moves does not turn with its way

double smooth(double value, double low, double high) {
    const double share = std::clamp((value - low) / (high - low), 0.0, 1.0);
    return share * share * (3.0 - 2.0 * share);
}

glm::dvec2 inPlane(const std::array<float, kComponents>& values) {
    return {values[0], values[1]};
}

/// The gait as the stream of states has it.
recording::GaitTrack gaitIn(const RowSample& sample) {
    const recording::GaitInState told = recording::gaitsOf(sample[Stream::state][0]);
    recording::GaitTrack gait;
    gait.phase = sample[Stream::state][2];
    gait.gait = told.gait;
    gait.before = told.before;
    if (told.left > 0.0) gait.changed = gait.phase - (1.0 - told.left) * recording::kGaitsBlendOver;
    return gait;
}

/// One person's way on its way to being bent.
class Bender {
  public:
    Bender(const LayeredCrowd& crowd, std::uint32_t row, const authoring::Bend& bend)
        : crowd_(crowd), fps_(crowd.bake().fps), scale_(static_cast<float>(crowd.scaleOf(row))) {
        track_.samples.resize(crowd.frames());
        for (std::uint32_t frame = 0; frame < crowd.frames(); ++frame) {
            track_.samples[frame] = crowd.at(row, frame).sample;
            if (track_.samples[frame][Stream::state][0] <= 0.5f) continue;
            first_ = std::min(first_, frame);
            last_ = frame;
        }
        if (first_ < crowd.frames()) findOffsets(bend);
    }

    BentTrack bent() {
        const auto bends =
            std::ranges::find_if(offsets_, [](glm::dvec2 by) { return by != glm::dvec2(0.0); });
        if (bends == offsets_.end()) return {};
        begins_ = std::max(static_cast<std::uint32_t>(bends - offsets_.begin()), first_);
        for (const RowSample& sample : track_.samples)
            before_.push_back(sample);
        movePlaces();
        turnHeadings();
        walk();
        findAcceleration();
        return std::move(track_);
    }

  private:
    RowSample& sample(std::uint32_t frame) { return track_.samples[frame]; }
    glm::dvec2 placeBefore(std::uint32_t frame) const { return inPlane(before_[frame][Stream::pos]); }
    glm::dvec2 place(std::uint32_t frame) const { return placeBefore(frame) + offsets_[frame]; }

    /// How far the way is off in each frame. Who is not there yet, or any more, is where it enters or has
    /// left.
    void findOffsets(const authoring::Bend& bend) {
        std::vector<double> where(crowd_.frames());
        double way = 0.0, fastest = 0.0;
        for (std::uint32_t frame = first_; frame <= last_; ++frame) {
            const double step = frame > first_ ? glm::distance(inPlane(sample(frame)[Stream::pos]),
                                                               inPlane(sample(frame - 1)[Stream::pos]))
                                               : 0.0;
            way += step;
            fastest = std::max(fastest, step);
            where[frame] = bend.by_way ? way : frame;
        }
        const auto overWhich = [&](const authoring::BendPoint& point) {
            const double seconds = BendCurve::timeFor(glm::length(point.by), bend.most_acceleration);
            const double frames = std::max(seconds * fps_, 1.0);
            return bend.falloff.value_or(bend.by_way ? frames * std::max(fastest, 1.0e-3) : frames);
        };
        const BendCurve curve(bend.points, overWhich(bend.points.front()), overWhich(bend.points.back()));
        for (std::uint32_t frame = 0; frame < crowd_.frames(); ++frame)
            offsets_.push_back(curve.at(where[std::clamp(frame, first_, last_)]));
    }

    void movePlaces() {
        for (std::uint32_t frame = 0; frame < crowd_.frames(); ++frame) {
            std::array<float, kComponents>& pos = sample(frame)[Stream::pos];
            const glm::dvec2 moved = place(frame);
            if (offsets_[frame] == glm::dvec2(0.0)) continue;  // to the last bit where it was
            pos[0] = static_cast<float>(moved.x);
            pos[1] = static_cast<float>(moved.y);
        }
    }

    /// By as much as the way turns.
    void turnHeadings() {
        for (std::uint32_t frame = 0; frame < crowd_.frames(); ++frame) {
            const std::uint32_t here = std::clamp(frame, first_, last_);
            const std::uint32_t low = std::max(here, first_ + 1) - 1, high = std::min(here + 1, last_);
            if (high == low) continue;
            const double rate = fps_ / (high - low);
            const glm::dvec2 was = rate * (placeBefore(high) - placeBefore(low));
            const glm::dvec2 is = rate * (place(high) - place(low));
            if (was == is) continue;
            const double share = smooth(std::min(glm::length(was), glm::length(is)), kTurnsFrom, kTurnsFully);
            const double angle = share * std::atan2(was.x * is.y - was.y * is.x, glm::dot(was, is));
            for (const StreamInfo& info : kStreams)
                if (info.in_plane == InPlane::direction) turn(sample(frame)[info.id], angle);
        }
    }

    static void turn(std::array<float, kComponents>& values, double angle) {
        const double x = values[0], y = values[1];
        values[0] = static_cast<float>(std::cos(angle) * x - std::sin(angle) * y);
        values[1] = static_cast<float>(std::sin(angle) * x + std::cos(angle) * y);
    }

    double speedIn(std::uint32_t frame) const {
        const double told = before_[frame][Stream::dir][2];
        if (frame == first_ || offsets_[frame] == offsets_[frame - 1]) return told;
        const double was = glm::distance(placeBefore(frame), placeBefore(frame - 1));
        const double is = glm::distance(place(frame), place(frame - 1));
        return was > 1.0e-6 ? told * is / was : is * fps_;
    }

    /// Speed, stride, phase, feet and trunk, in the order of the frames: each depends on those before.
    void walk() {
        recording::Carriages carriages({0.25f}, fps_, crowd_.bake().minimum, crowd_.bake().maximum);
        recording::Footsteps footsteps(1, fps_);
        recording::GaitTrack gait;
        for (std::uint32_t frame = first_; frame <= last_; ++frame) {
            const double speed = speedIn(frame);
            if (frame <= begins_) {
                gait = gaitIn(before_[frame]);
            } else {
                gait.advance(speed / fps_, 1.0 / fps_);
                putGait(sample(frame), speed, gait);
            }
            const glm::vec2 moved(frame > first_ ? place(frame) - place(frame - 1) : glm::dvec2(0.0));
            const float walking = carriages.step(0, speed);
            const auto feet =
                footsteps.step(0,
                               {glm::vec2(place(frame)), glm::vec2(inPlane(sample(frame)[Stream::dir])),
                                moved, static_cast<float>(speed), walking, scale_},
                               gait);
            if (frame > begins_) putFeet(sample(frame), feet, carriages[0]);
        }
        for (std::uint32_t frame = last_ + 1; frame < crowd_.frames(); ++frame)
            sample(frame)[Stream::state][2] = static_cast<float>(gait.phase);
    }

    static void putGait(RowSample& sample, double speed, const recording::GaitTrack& gait) {
        sample[Stream::dir][2] = static_cast<float>(speed);
        std::array<float, kComponents>& state = sample[Stream::state];
        state[0] = std::floor(state[0]) + gait.inState();
        state[2] = static_cast<float>(gait.phase);
    }

    /// Shoulders stay turned as they were: whom they make room for is not known here.
    void putFeet(RowSample& sample, const std::array<recording::FootMove, 2>& feet,
                 const recording::Carriage& carriage) const {
        if (!crowd_.source().streams().has(Stream::left_foot)) return;
        for (const std::size_t side : {0u, 1u})
            sample[side == 0 ? Stream::left_foot : Stream::right_foot] = {feet[side].forward, feet[side].left,
                                                                          recording::turnAndLift(feet[side])};
        sample[Stream::carriage][0] = carriage.walking;
        sample[Stream::carriage][2] = carriage.lean;
    }

    void findAcceleration() {
        for (std::uint32_t frame = first_ + 1; frame + 1 <= last_; ++frame) {
            const double added =
                glm::length(offsets_[frame + 1] - 2.0 * offsets_[frame] + offsets_[frame - 1]) * fps_ * fps_;
            if (added <= track_.acceleration) continue;
            track_.acceleration = added;
            track_.frame = frame;
        }
    }

    const LayeredCrowd& crowd_;
    double fps_;
    float scale_;
    BentTrack track_;
    std::vector<RowSample> before_;
    std::vector<glm::dvec2> offsets_;  ///< m, by frame
    std::uint32_t first_ = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t last_ = 0;    ///< first and last frame in which it is there
    std::uint32_t begins_ = 0;  ///< first frame in which it is elsewhere
};

}  // namespace

BentTrack bendTrack(const LayeredCrowd& crowd, std::uint32_t row, const authoring::Bend& bend) {
    return Bender(crowd, row, bend).bent();
}

}  // namespace throng::io
