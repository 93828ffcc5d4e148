// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/capsule.h"
#include "io/bake_reader.h"

namespace throng::analysis {

/// How near vehicles come to people, from the files of a bake. Who is in an open door gets on or off.
class VehicleWatch {
  public:
    explicit VehicleWatch(const io::Bake& bake);
    /// In a frame, all that there is of somebody.
    /// @param height m, of the ground there: who is above or below a vehicle is not near to it
    void look(std::uint32_t frame, std::uint32_t row, const Capsule& body, double height);

    bool empty() const { return bake_.vehicles.empty(); }
    /// m, of all; below 0 somebody was in one; none where nobody came near one.
    std::optional<double> clearance() const { return least_; }
    /// People whom a vehicle was in by more than a centimetre.
    std::uint32_t runOver() const;

  private:
    std::span<const float> placeOf(std::uint32_t frame, std::size_t vehicle) const;
    /// Whether somebody is between the open leaves of a door. @param place along the vehicle and to its left
    bool isInDoorway(std::uint32_t frame, std::size_t vehicle, glm::dvec2 place) const;

    const io::Bake& bake_;
    std::vector<float> track_, doors_;
    std::optional<double> least_;
    std::vector<bool> run_over_;  // by row
};

}  // namespace throng::analysis
