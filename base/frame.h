// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/streams.h"

/// What the simulation hands to the writers. No GL here: the writers and their tests need no GPU.
namespace throng {

/// Marks a pixel without an owner, and "never" where a frame number is expected.
inline constexpr std::uint32_t kNone = 0xffffffffu;

/// The truncated Voronoi diagram of one frame, bottom row first (as the world's Y goes up).
struct DiagramImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    glm::vec2 minimum{0.0f};  ///< scene frame, m: the corner of pixel (0, 0)
    float pixels_per_metre = 1.0f;
    std::uint32_t agent_count = 0;        ///< site ids below this are agents (rows), the next ones wall tiles
    std::span<const std::uint32_t> site;  ///< width * height, kNone where no site's tile reaches
    std::span<const float> distance;      ///< width * height, m to the owner; undefined where site is kNone
    /// width * height, the second-nearest site that reaches, kNone where there is none; empty unless asked
    /// for
    std::span<const std::uint32_t> second;
    std::uint32_t wall_count = kNone;  ///< wall tiles; ids above theirs are vehicles
};

/// One frame of all rows. The spans stay valid only while the receiver is being called.
struct Frame {
    std::uint32_t index = 0;  ///< from 0
    /// rows x 3 values each, places in the scene frame; empty where there is no such stream
    PerStream<std::span<const float>> streams{};
    const DiagramImage* diagram = nullptr;
    /// kVehicleFloats of each vehicle, as base/vehicle_track.h has them; empty where there are none
    std::span<const float> vehicles{};
    /// kLiftFloats of each lift, as base/lift_track.h has them; empty where there are none
    std::span<const float> lifts{};
    /// kDoorFloats of each vehicle, as base/door_track.h has them; empty where none has doors that are used
    std::span<const float> doors{};

    std::span<const float>& operator[](Stream stream) { return streams[stream]; }
    std::span<const float> operator[](Stream stream) const { return streams[stream]; }
};

enum class AgentStatus : std::uint32_t {
    waiting = 0,  ///< not yet in the scene: its time has not come or its entry has no free room
    walking = 1,
    arrived = 2,
    refused = 3,  ///< the bake ended before it could enter
};

/// What became of one row.
struct AgentOutcome {
    AgentStatus status = AgentStatus::waiting;
    std::uint32_t spawn_frame = kNone;    ///< first frame it is alive in; kNone = never
    std::uint32_t arrival_frame = kNone;  ///< first frame at which it has arrived; kNone = never
    float distance_walked = 0.0f;         ///< m
    float shortest_way = 0.0f;            ///< m from where it began to its goal, round walls
    std::string reason;                   ///< why it was refused; empty otherwise
};

/// The account of a bake: nobody disappears silently. agents = walking + arrived + refused.
struct Account {
    std::vector<AgentOutcome> agents;
    std::uint32_t spawned = 0;
    std::uint32_t walking = 0;
    std::uint32_t arrived = 0;
    std::uint32_t refused = 0;
};

}  // namespace throng
