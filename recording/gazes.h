// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "base/plane_grid.h"
#include "recording/onlooker.h"

namespace throng::recording {

/// Which way somebody looks.
struct Gaze {
    float yaw = 0.0f;    ///< rad, from the heading to the left
    float pitch = 0.0f;  ///< rad, up
    float at = 0.0f;     ///< the row of who is looked at, and one more; 0: nobody
};

/// Where people look.
///
/// Heads that never turn are what gives crowds away first. Who walks looks where the way leads, a little
/// down, and into a turn before the body is through it, by a fifth to a third of a second (Grasso, Prevost,
/// Ivanenko and Berthoz 1998). Now and then people look at somebody: at those whom they walk or stand
/// together with, at who comes towards them, at others nearby; or aside at nothing. For how long, and at
/// whom, is drawn from the row alone, so the same motion gives the same gazes. Heads follow as critically
/// damped springs. All shares and times are by eye; necks turn by 70 degrees.
class Gazes {
  public:
    Gazes(std::size_t rows, double fps, glm::dvec2 minimum, glm::dvec2 maximum);

    /// The next frame. @param people all who are there, by row
    void look(std::span<const Onlooker> people);
    Gaze operator[](std::size_t row) const;

    /// All that later frames depend on.
    std::span<std::byte> state() { return std::as_writable_bytes(std::span(heads_)); }
    std::span<const std::byte> state() const { return std::as_bytes(std::span(heads_)); }

  private:
    struct Head {
        float yaw = 0.0f, yaw_rate = 0.0f, pitch = 0.0f, pitch_rate = 0.0f;
        float direction = 0.0f;         ///< rad, of the body in the frame before
        float aside = 0.0f, up = 0.0f;  ///< rad: where to, where nobody is looked at
        float left = 0.0f;              ///< s, until the eyes go elsewhere
        std::uint32_t at = 0;           ///< as Gaze::at
        std::uint32_t draws = 0;
        std::uint32_t known = 0;  ///< 0: has not been here yet
    };
    double draw(std::uint32_t row);
    std::uint32_t whoDraws(const Onlooker& self, std::span<const Onlooker> people, std::uint32_t before);
    void choose(const Onlooker& self, std::span<const Onlooker> people);
    void follow(const Onlooker& self, std::span<const Onlooker> people);
    const Onlooker* seenBy(const Onlooker& self, std::span<const Onlooker> people) const;

    double interval_;  ///< s
    std::vector<Head> heads_;
    std::vector<std::uint32_t> index_;  ///< of rows, in the people of this frame; kNone of who is not there
    std::vector<glm::dvec2> places_;
    PlaneGrid grid_;
};

}  // namespace throng::recording
