// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <vector>

#include "authoring/terrain/terrain.h"
#include "recording/gaits.h"

namespace throng::recording {

/// How somebody stands in one frame.
struct Stance {
    float height = 0.0f;  ///< m, of the clip's ground under the body
    float along = 0.0f;   ///< its slope in the direction of the heading: 0.1 = 10 % up
    float across = 0.0f;  ///< and to the left
    float ground = 0.0f;  ///< m, of the very ground under the body
};

/// How high people are, and how the ground under their feet slopes.
///
/// A renderer has clips made for flat ground; it shears them, so that the clip's ground follows a slope while
/// bodies stay upright. What has to be right is where feet are planted. The ground is therefore taken apart:
/// a smooth one without steps, which people follow wherever they go, and the height of the very ground over
/// it, which counts at feet only. While one foot is planted, that height is that of its place; it goes over
/// to the next foot's in a straight line while the body moves from above the one to above the other. So a
/// planted foot stays on its tread, and bodies go up stairs without jerks.
///
/// The place of the next foot is known when the other one is under the body: the gait's phase follows the way
/// walked.
class Footing {
  public:
    Footing(std::shared_ptr<const authoring::Terrain> terrain, std::size_t rows, double fps);

    struct Walker {
        glm::vec2 place{0.0f};
        glm::vec2 heading{1.0f, 0.0f};  ///< unit vector
        glm::vec2 moved{0.0f};          ///< m, since the frame before, on the ground; zero in the first one
        bool is_carried = false;        ///< by ground that moves: who stands there stands level, on a step
    };
    /// The next frame of somebody.
    Stance stand(std::size_t row, const Walker& walker, const GaitTrack& gait);
    /// As stand() begins, of somebody who has yet to come.
    Stance entering(glm::vec2 place, glm::vec2 heading) const;
    /// The last one, of somebody who has left.
    const Stance& last(std::size_t row) const { return feet_[row].stance; }

    /// All that later frames depend on.
    std::span<std::byte> state() { return std::as_writable_bytes(std::span(feet_)); }
    std::span<const std::byte> state() const { return std::as_bytes(std::span(feet_)); }

  private:
    struct Feet {
        Stance stance;
        float step_from =
            0.0f;  ///< m: how much higher the ground under the planted foot is than the smooth ground
        float step_to = 0.0f;     ///< the same under the next foot
        float standing = 0.0f;    ///< 1 = on both feet, 0 = walks
        double half_cycle = 0.0;  ///< which half of which gait cycle it is in
        std::uint64_t known = 0;  ///< 0: has not been here yet
    };
    float stepAt(glm::vec2 place) const;

    std::shared_ptr<const authoring::Terrain> terrain_;
    double fps_;
    std::vector<Feet> feet_;
};

}  // namespace throng::recording
