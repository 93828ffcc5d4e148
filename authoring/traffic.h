// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "authoring/source_position.h"

/// What a layout says of signals and vehicles. Units as in authoring/layout.h.
namespace throng::authoring {

/// Where people cross lanes. Vehicles let them over; where a signal has it, people wait at its edge while it
/// is red.
struct Zebra {
    std::string id;
    std::vector<glm::dvec2> polygon;  ///< simple, any winding
    SourcePosition where;
    std::size_t level = 0;  ///< that it lies on, index into the layout's levels if there are any
};

/// What a signal can hold: a crossing or a lane, by its index.
struct Lit {
    bool is_lane = false;
    std::size_t index = 0;
    bool operator==(const Lit&) const = default;
};

/// A part of a signal's cycle.
struct Phase {
    std::string name;
    double seconds = 0.0;
    std::vector<std::size_t> crossings, lanes;  ///< that are green in it: indices
    bool isGreen(const Lit& what) const;
};

/// Goes round through its phases for ever. What is green in one of them is red in all others that do not name
/// it.
struct Signal {
    std::string id;
    double offset = 0.0;  ///< s: how far into its cycle it is at time 0
    std::vector<Phase> phases;
    SourcePosition where;

    double cycle() const;
    /// Whether any phase of it is green for that.
    bool holds(const Lit& what) const;
    /// Index of the phase at a time, s.
    std::size_t phaseAt(double time) const;
};

/// Where people get on and off.
struct StopPlatform {
    std::string id;
    std::size_t area = 0;  ///< index: where people wait
    double least = 10.0;   ///< s from when a vehicle stands there to when it goes on
    double most = 40.0;    ///< likewise, while people still get on or off
};

/// Where vehicles of a lane stop: at a red signal, for a time, or at a platform those that have doors.
struct LaneStop {
    glm::dvec2 at{0.0};                 ///< on the lane, or beside it
    std::optional<std::size_t> signal;  ///< index; none: everybody stops there
    double seconds = 0.0;               ///< s that they stand there
    SourcePosition where;
    std::optional<StopPlatform> platform;  ///< in place of both
};

/// What vehicles follow, from its first point to its last.
struct Lane {
    std::string id;
    std::vector<glm::dvec2> points;
    double width = 3.0;   ///< m
    double speed = 13.9;  ///< m/s, the most that is allowed
    std::vector<LaneStop> stops;
    SourcePosition where;
    std::size_t level = 0;  ///< as of crossings
};

enum class VehicleKind { car, bus, tram, bicycle };

/// Sizes, and the numbers of the intelligent driver model (Treiber, Hennecke and Helbing 2000).
struct VehicleType {
    const char* name;
    double length, width, height;  ///< m
    double speed;                  ///< m/s that it would like where the lane allows more
    double headway;                ///< s
    double acceleration, braking;  ///< m/s^2: what is comfortable
    double gap;                    ///< m, to what it stands behind
    double wheel;                  ///< m, radius
};

inline constexpr std::array<VehicleType, 4> kVehicleTypes{{
    {"car", 4.5, 1.8, 1.5, 13.9, 1.2, 1.5, 2.0, 2.0, 0.32},
    {"bus", 12.0, 2.5, 3.1, 12.0, 1.5, 1.0, 1.5, 2.0, 0.48},
    {"tram", 28.0, 2.4, 3.4, 14.0, 2.0, 1.0, 1.3, 2.5, 0.33},
    {"bicycle", 1.8, 0.6, 1.75, 4.5, 1.0, 0.8, 2.0, 1.0, 0.34},
}};

inline const VehicleType& typeOf(VehicleKind kind) {
    return kVehicleTypes[static_cast<std::size_t>(kind)];
}

/// Where people get on and off a vehicle.
struct VehicleDoors {
    enum class Sides { left = 1, right = 2, both = 3 };
    std::vector<double> at;  ///< m behind its front: their middles
    double width = 1.3;      ///< m
    double flow = 1.0;       ///< persons/s through each
    double time = 2.0;       ///< s, to open or to close
    Sides sides = Sides::right;
};

/// Those that a vehicle has unless told otherwise; none: it has no doors.
std::optional<VehicleDoors> doorsOf(VehicleKind kind);
/// How many people it holds, unless told otherwise.
std::uint32_t capacityOf(VehicleKind kind);

/// Vehicles of one kind that come onto a lane.
struct VehicleFlow {
    std::string id;
    std::size_t lane = 0;  ///< index
    VehicleKind kind = VehicleKind::car;
    std::optional<double> rate;  ///< vehicles/s at random moments; or
    std::vector<double> times;   ///< s
    double start = 0.0, end = 0.0;
    SourcePosition where;
    std::optional<VehicleDoors> doors{};
    std::uint32_t capacity = 0;             ///< people
    std::optional<std::uint32_t> aboard{};  ///< people, as each of them comes in; none: those who get off
};

/// Where people get on or off, and what.
struct AtPlatform {
    std::size_t lane = 0, stop = 0;    ///< indices
    std::vector<std::size_t> lines{};  ///< of the flows of vehicles
    SourcePosition where{};
};

struct Traffic {
    std::vector<Zebra> crossings;
    std::vector<Signal> signals;
    std::vector<Lane> lanes;
    std::vector<VehicleFlow> vehicles;
    bool empty() const { return crossings.empty() && lanes.empty(); }
};

}  // namespace throng::authoring
