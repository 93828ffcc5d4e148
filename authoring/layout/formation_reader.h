// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "authoring/layout.h"
#include "authoring/layout/behaviour_reader.h"
#include "authoring/layout/level_reader.h"
#include "authoring/layout/object_reader.h"
#include "authoring/layout/place_reader.h"

namespace throng::authoring {

/// Reads formations, after flows.
class FormationReader {
  public:
    FormationReader(const Schema& schema, Layout& layout, PlaceReader& places, LevelReader& levels,
                    BehaviourReader& behaviours, Indices& groups, Diagnostics& diagnostics)
        : schema_(schema),
          layout_(layout),
          places_(places),
          levels_(levels),
          behaviours_(behaviours),
          groups_(groups),
          diagnostics_(diagnostics) {}

    void read(const JsonNode& node);

  private:
    CircleFormation readCircle(ObjectReader& reader);
    bool isGoal(const JsonNode& goal);
    GridFormation readGrid(ObjectReader& reader, bool behaves);
    ListFormation readList(ObjectReader& reader, bool behaves, double start);
    void readGoal(ObjectReader& reader, const JsonNode& node, bool behaves, ListedAgent& agent);
    void readVia(ObjectReader& reader, ListedAgent& agent);

    const Schema& schema_;
    Layout& layout_;
    PlaceReader& places_;
    LevelReader& levels_;
    BehaviourReader& behaviours_;
    Indices& groups_;
    Diagnostics& diagnostics_;
};

}  // namespace throng::authoring
