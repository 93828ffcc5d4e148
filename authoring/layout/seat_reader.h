// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "authoring/layout.h"
#include "authoring/layout/level_reader.h"
#include "authoring/layout/object_reader.h"
#include "authoring/layout/place_reader.h"

namespace throng::authoring {

/// Reads blocks of seats and what their audiences do.
class SeatReader {
  public:
    /// @param groups ids of flows and formations, to which those of blocks are added; @param walls likewise,
    /// of walls
    SeatReader(const Schema& schema, Layout& layout, const PlaceReader& places, const LevelReader& levels,
               Indices& groups, Indices& walls, Diagnostics& diagnostics)
        : schema_(schema),
          layout_(layout),
          places_(places),
          levels_(levels),
          groups_(groups),
          walls_(walls),
          diagnostics_(diagnostics) {}

    void readBlock(const JsonNode& node);
    /// After all blocks.
    void readShow(const JsonNode& node);

    /// After all behaviours: which blocks people walk to or leave, and what those do who sit there.
    void open();

    bool hasBlock(const std::string& id) const { return blocks_.contains(id); }

  private:
    void readLeave(const JsonNode& node, SeatBlock& block);
    void readMouths(ObjectReader& reader, SeatBlock& block) const;
    void checkOnTerrain(const JsonNode& node, const SeatBlock& block) const;
    void checkMouths(const JsonNode& node, const SeatBlock& block) const;
    void checkPassage(const SeatBlock& block) const;
    void checkOpenings(const SeatBlock& block) const;
    void openBlock(SeatBlock& block);
    void leadTo(BehaviourState& state) const;
    void readArc(ObjectReader& reader, const JsonNode& node, SeatBlock& block);
    void checkBlock(const SeatBlock& block, const JsonNode& node) const;
    void addStands(const SeatBlock& block);
    void addStand(const SeatBlock& block, std::vector<glm::dvec2> outline, std::size_t level);
    void readAudience(const JsonNode* list, Show& show) const;
    void readWave(ObjectReader& reader, const JsonNode& node, Show& show) const;

    const Schema& schema_;
    Layout& layout_;
    const PlaceReader& places_;
    const LevelReader& levels_;
    Indices& groups_;
    Indices& walls_;
    Diagnostics& diagnostics_;
    Indices blocks_;
};

}  // namespace throng::authoring
