// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "authoring/layout.h"
#include "authoring/layout/object_reader.h"

namespace throng::authoring {

/// Reads platforms, doors of vehicles, and who gets on or off.
class BoardingReader {
  public:
    /// @param areas by id
    BoardingReader(const Schema& schema, Layout& layout, const Indices& areas, Diagnostics& diagnostics)
        : schema_(schema), layout_(layout), areas_(areas), diagnostics_(diagnostics) {}

    /// What a stop of a lane says of its platform, if it has one.
    void readPlatform(ObjectReader& reader, const JsonNode& node, LaneStop& stop);
    /// The doors of vehicles, and how many people these hold.
    void readVehicle(ObjectReader& reader, VehicleFlow& flow);
    /// Where a flow's people get on or off. After all lanes and vehicles.
    /// @returns nothing where it cannot be, which has been told
    std::optional<AtPlatform> atPlatform(const JsonNode& node);
    /// The flow's people get off: tells of what such a flow cannot have.
    void checkAlighting(const JsonNode& node);
    /// The area of a platform, as a place.
    Place placeOf(const AtPlatform& at) const;

  private:
    void readDwell(ObjectReader& reader, StopPlatform& platform);
    void readDoors(const JsonNode& node, VehicleFlow& flow);
    void checkDoors(const JsonNode& node, const VehicleFlow& flow);
    std::optional<AtPlatform> stopNamed(const JsonNode& name) const;
    void readLines(const JsonNode& list, AtPlatform& at) const;

    const Schema& schema_;
    Layout& layout_;
    const Indices& areas_;
    Diagnostics& diagnostics_;
    Indices ids_;  // of platforms
};

}  // namespace throng::authoring
