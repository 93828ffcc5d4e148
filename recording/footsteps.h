// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "recording/gaits.h"

namespace throng::recording {

/// How far a foot is from where the clip has it.
struct FootMove {
    float forward = 0.0f;  ///< m, along the heading
    float left = 0.0f;     ///< m
    float turn = 0.0f;     ///< rad, counter-clockwise, about the ankle
    float lift = 0.0f;     ///< m
};

/// What the streams of feet have as third component: both in one number, as point caches know no fourth.
/// The turn, in steps of 1/512 rad, is its floor, the lift the rest.
inline constexpr float kTurnSteps = 512.0f;
float turnAndLift(const FootMove& move);
FootMove footMoveOf(std::span<const float, 3> values);

/// Holds feet where they came down.
///
/// The planted foot of a clip goes backwards exactly as fast as somebody goes forward who walks straight on:
/// it stays where it is. People turn, drift aside, are pushed, set off and stop, and then it slides. Nor has
/// a clip of standing any steps, so who turns on the spot or shuffles in a queue glides like a chessman. So
/// for each foot the bake tells by how much a renderer has to move it from where the clip has it.
///
/// A foot is planted while its clip's is, and while somebody stands; then it keeps its place and its
/// direction in the world. In the air its distance from the clip's goes away as that of a critically damped
/// spring, though not to nothing: to half the way that the clip's foot will slide while the foot is down
/// next, so that it comes down ahead of somebody who drifts aside, and is as far behind when it leaves. A
/// foot that is too far from its clip's makes a step of its own: one foot at a time.
class Footsteps {
  public:
    struct Walker {
        glm::vec2 place{0.0f};  ///< m
        glm::vec2 heading{1.0f, 0.0f};
        glm::vec2 moved{0.0f};    ///< m, since the frame before, on the ground
        float speed = 0.0f;       ///< m/s, as the stream has it
        float walking = 0.0f;     ///< share of the walk in the clip's pose (Carriage)
        float scale = 1.0f;       ///< of the figure
        glm::vec2 carried{0.0f};  ///< m: how far the ground under the feet has moved since the frame before
    };

    Footsteps(std::size_t rows, double fps);

    /// The next frame of somebody: the left foot's and the right one's.
    std::array<FootMove, 2> step(std::size_t row, const Walker& walker, const GaitTrack& gait);

    /// All that later frames depend on.
    std::span<std::byte> state() { return std::as_writable_bytes(std::span(people_)); }
    std::span<const std::byte> state() const { return std::as_bytes(std::span(people_)); }

  private:
    enum class Contact : std::uint32_t { planted, swings, steps };
    struct Foot {
        glm::vec2 anchor{0.0f};            ///< m: where it is planted
        glm::vec2 away{0.0f}, rate{0.0f};  ///< m, m/s: from the clip's
        float facing = 0.0f;               ///< rad: its direction where it is planted
        float turn = 0.0f, turn_rate = 0.0f;
        float since = 0.0f;                 ///< s: planted, or in the air
        float height = 0.0f, lasts = 0.0f;  ///< m, s: of the step
        Contact contact = Contact::planted;
    };
    struct Person {
        std::array<Foot, 2> feet;
        float direction = 0.0f;   ///< rad, of the heading in the frame before
        float walking = 0.0f;     ///< the share of it in that frame
        std::uint32_t known = 0;  ///< 0: has not been here yet
    };
    struct Moment;
    void lift(Person& person, const Moment& now) const;
    void move(Foot& foot, const Moment& now, std::size_t side) const;

    float interval_;  ///< s
    std::vector<Person> people_;
};

}  // namespace throng::recording
