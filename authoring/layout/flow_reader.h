// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "authoring/layout.h"
#include "authoring/layout/behaviour_reader.h"
#include "authoring/layout/boarding_reader.h"
#include "authoring/layout/object_reader.h"
#include "authoring/layout/place_reader.h"

namespace throng::authoring {

/// Reads flows, after the places, platforms and behaviours that they name.
class FlowReader {
  public:
    FlowReader(const Schema& schema, Layout& layout, PlaceReader& places, BehaviourReader& behaviours,
               BoardingReader& boarding, Indices& groups, Diagnostics& diagnostics)
        : schema_(schema),
          layout_(layout),
          places_(places),
          behaviours_(behaviours),
          boarding_(boarding),
          groups_(groups),
          diagnostics_(diagnostics) {}

    void read(const JsonNode& node);

  private:
    std::optional<Place> readBeginning(ObjectReader& reader, const JsonNode& node, Flow& flow);
    std::optional<Destination> readEnd(ObjectReader& reader, const JsonNode& node, Flow& flow);
    void readAmount(ObjectReader& reader, const JsonNode& node, Flow& flow);
    void checkEnds(const Flow& flow);

    const Schema& schema_;
    Layout& layout_;
    PlaceReader& places_;
    BehaviourReader& behaviours_;
    BoardingReader& boarding_;
    Indices& groups_;
    Diagnostics& diagnostics_;
};

}  // namespace throng::authoring
