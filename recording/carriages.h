// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "base/plane_grid.h"
#include "recording/onlooker.h"

namespace throng::recording {

/// From where a renderer's clips stop standing, and from where they walk and nothing else; between the two
/// both are blended. m/s. Renderers that know no Carriage have the same (blender_addon/throng/crowd/near.py).
inline constexpr double kStandsBelow = 0.03, kWalksFrom = 0.35;

inline constexpr float kMostTwist = 0.7f;  ///< rad, of shoulders over hips

/// How somebody carries the body over the feet.
struct Carriage {
    float walking = 0.0f;  ///< share of the walk in the pose; the rest is how it stands
    float twist = 0.0f;    ///< rad, of the shoulders, from the heading to the left
    float lean = 0.0f;     ///< rad, of the trunk, forwards
};

/// How people carry their bodies.
///
/// Bodies have inertia that discs have not. A disc stops within two frames; legs and arms that stopped with
/// it would jump from the middle of a stride into a stand and back. So how much of the walk is in a pose
/// follows the speed over a third of a second. Who speeds up leans into it and who brakes leans back, by a
/// part of what a body that must not fall over would need, as feet are put ahead and behind, too.
///
/// Shoulders are broader than chests are deep: who passes by closely turns the shoulder on that side back,
/// and so needs less room (measured in passing and crossing flows by Yamamoto, Yanagisawa, Feliciani and
/// Nishinari 2019); between two people it goes sideways. Here bodies are discs and pass as such; the turn is
/// what is shown of it. Who walks with others abreast, or stands in a queue, passes nobody and turns nothing.
/// How far is by eye.
class Carriages {
  public:
    /// @param radii m, by row; @param minimum, maximum of the site, m
    Carriages(std::vector<float> radii, double fps, glm::dvec2 minimum, glm::dvec2 maximum);

    /// The next frame of somebody. @param speed m/s. @returns the share of walking
    float step(std::size_t row, double speed);
    /// Turns the shoulders of all who are there, each after its step().
    void squeeze(std::span<const Onlooker> people);
    Carriage operator[](std::size_t row) const;

    /// All that later frames depend on.
    std::span<std::byte> state() { return std::as_writable_bytes(std::span(bodies_)); }
    std::span<const std::byte> state() const { return std::as_bytes(std::span(bodies_)); }

  private:
    struct Body {
        float walking = 0.0f, walking_rate = 0.0f;
        float pace = 0.0f, pace_rate = 0.0f;  ///< m/s, m/s^2: the speed as the trunk follows it
        float lean = 0.0f, lean_rate = 0.0f;
        float twist = 0.0f, twist_rate = 0.0f;
        std::uint32_t known = 0;  ///< 0: has not been here yet
    };
    struct Sides {
        double left = 0.0, right = 0.0;  ///< how much there is to turn away from, 0 to 1
    };
    Sides tightness(const Onlooker& self, std::span<const Onlooker> people) const;

    std::vector<float> radii_;  ///< m
    float interval_;            ///< s
    std::vector<Body> bodies_;
    std::vector<glm::dvec2> places_;
    PlaneGrid grid_;
};

}  // namespace throng::recording
