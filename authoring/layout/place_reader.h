// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "authoring/layout.h"
#include "authoring/layout/object_reader.h"

namespace throng::authoring {

/// Reads what names roads and areas: places, destinations and stops.
class PlaceReader {
  public:
    PlaceReader(const Schema& schema, const Indices& roads, const Indices& areas, Diagnostics& diagnostics)
        : schema_(schema), roads_(roads), areas_(areas), diagnostics_(diagnostics) {}

    std::optional<Place> place(const JsonNode& node) const;
    /// Whether a name is an area's, or could be meant for an end of a road.
    bool isPlace(const std::string& name) const;
    /// All places, as a layout names them.
    std::vector<std::string> names() const;
    /// A place, {"nearest": [places]} or {"choose": {place: weight}}.
    std::optional<Destination> destination(const JsonNode& node) const;
    /// A destination, or an object with one under `at` and what happens there.
    std::optional<BehaviourState> stop(const JsonNode& node) const;

  private:
    SchemaRule rule() const { return schema_.definition("destination"); }
    std::optional<Place> placeNamed(const std::string& name, const SourcePosition& where) const;
    Destination nearestOf(const JsonNode& list) const;
    Destination choiceOf(const JsonNode& shares) const;
    void readWhatHappens(ObjectReader& reader, const JsonNode& node, BehaviourState& stop) const;

    const Schema& schema_;
    const Indices& roads_;
    const Indices& areas_;
    Diagnostics& diagnostics_;
};

}  // namespace throng::authoring
