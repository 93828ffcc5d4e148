// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "io/agent_rows.h"
#include "io/bake_reader.h"
#include "io/storeys.h"

namespace throng::analysis {

/// Packs who is where in a moment, for those who look on while there come more and more of them.
///
/// All numbers are little-endian. A moment is its frame (32 bits); for each person x and y, in steps of
/// `quantum` from the bounds' corner (16 bits each); for each person a byte: 0 where it is not there, or 1
/// and the number of its level or link (io::Storeys), 255 where it is on none; and for each vehicle x and y
/// in steps of `ground.quantum` from `ground.minimum`, the heading in 65,536ths of a turn, and its state (16
/// bits each; base/vehicle_track.h).
class MomentPacker {
  public:
    /// @param bake outlives this; @param per_second so many moments of a second are kept, about
    MomentPacker(const io::Bake& bake, double per_second);

    std::uint32_t every() const { return every_; }  ///< frames from one moment to the next
    /// The last frame is always a moment.
    bool wants(std::uint32_t frame) const { return frame % every_ == 0 || frame + 1 == bake_.frames; }

    /// What a player has to know of the crowd first. @param with_vehicles whether moments have them
    nlohmann::ordered_json about(const std::vector<io::AgentRow>& people, bool with_vehicles) const;

    /// @param places, states as the streams `pos` and `state` have them; @param vehicles kVehicleFloats of
    /// each, or none
    std::string pack(std::uint32_t frame, std::span<const float> places, std::span<const float> states,
                     std::span<const float> vehicles) const;

  private:
    const io::Bake& bake_;
    io::Storeys storeys_;
    std::uint32_t every_;
    double quantum_;              ///< m
    glm::dvec2 vehicle_minimum_;  ///< m
    double vehicle_quantum_;      ///< m
};

}  // namespace throng::analysis
