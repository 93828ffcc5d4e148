// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "authoring/layout.h"
#include "authoring/layout/boarding_reader.h"
#include "authoring/layout/level_reader.h"
#include "authoring/layout/object_reader.h"

namespace throng::authoring {

/// Reads crossings, lanes, signals and vehicles. Signals name crossings and lanes, and lanes name signals: so
/// lanes are read first, and what they say of signals is looked up at the end.
class TrafficReader {
  public:
    TrafficReader(const Schema& schema, Layout& layout, const LevelReader& levels, BoardingReader& boarding,
                  Diagnostics& diagnostics)
        : schema_(schema), layout_(layout), levels_(levels), boarding_(boarding), diagnostics_(diagnostics) {}

    void readCrossing(const JsonNode& node);
    void readLane(const JsonNode& node);
    /// After all crossings and lanes.
    void readSignal(const JsonNode& node);
    /// After all lanes.
    void readVehicles(const JsonNode& node);
    /// What a signal can hold, by its name; told where there is none. After all crossings and lanes.
    std::optional<Lit> litBy(const JsonNode& node) const;
    /// After everything.
    void finish();

  private:
    struct NamedSignal {
        std::size_t lane, stop;
        const JsonNode* name;
    };

    void readStop(const JsonNode& node, Lane& lane);
    void readPhase(const JsonNode& node, Signal& signal);
    void readGreen(const JsonNode& node, Phase& phase);
    void readAmount(ObjectReader& reader, const JsonNode& node, VehicleFlow& flow);
    void checkStop(const Lane& lane, const LaneStop& stop) const;
    void checkSignal(const Signal& signal) const;
    void checkLights();

    const Schema& schema_;
    Layout& layout_;
    const LevelReader& levels_;
    BoardingReader& boarding_;
    Diagnostics& diagnostics_;
    Indices crossings_, lanes_, signals_, flows_;
    std::vector<NamedSignal> named_;
};

}  // namespace throng::authoring
