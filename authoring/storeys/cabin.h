// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "authoring/layout.h"

namespace throng::authoring {

/// Where people stand in the cabin of a lift: in rows along its doors, the first at its back.
struct CabinSpots {
    glm::dvec2 apart{0.0};  ///< m, along the doors and away from them
    std::uint32_t columns = 0, rows = 0;

    std::uint32_t count() const { return columns * rows; }
};

/// As many as the largest of the layout's people have room for; they face the doors.
CabinSpots spotsIn(const Layout& layout, const Lift& lift);

/// The most people in the cabin.
std::uint32_t capacityOf(const Layout& layout, const Lift& lift);

/// Out of the cabin at one of its stops: a unit vector.
glm::dvec2 outOfCabin(const Lift& lift, std::size_t stop);

/// m: of the ground before its doors there.
double heightOfStop(const Layout& layout, const Lift& lift, std::size_t stop);

/// s, from one height to another: it sets out and comes to rest evenly.
double travelTime(const Lift& lift, double rise);

/// s from one end to the other and back, with a stop at each.
/// @param whole m, from its lowest stop to its highest
double roundOfLift(const Lift& lift, double whole);

/// s from coming to the doors at one stop until they have opened at another, as people reckon.
/// @param whole m, from its lowest stop to its highest
double timeByLift(const Lift& lift, double whole, double rise);

}  // namespace throng::authoring
