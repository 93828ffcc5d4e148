// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "authoring/layout.h"
#include "authoring/layout/object_reader.h"

namespace throng::authoring {

/// Reads blocks of seats and what their audiences do.
class SeatReader {
  public:
    using Indices = std::map<std::string, std::size_t>;  // by id
    /// @param groups ids of flows and formations, to which those of blocks are added; @param walls likewise,
    /// of walls
    SeatReader(const Schema& schema, Layout& layout, Indices& groups, Indices& walls,
               Diagnostics& diagnostics)
        : schema_(schema), layout_(layout), groups_(groups), walls_(walls), diagnostics_(diagnostics) {}

    void readBlock(const JsonNode& node);
    /// After all blocks.
    void readShow(const JsonNode& node);

    bool hasBlock(const std::string& id) const { return blocks_.contains(id); }

  private:
    void readArc(ObjectReader& reader, const JsonNode& node, SeatBlock& block);
    void checkBlock(const SeatBlock& block, const JsonNode& node) const;
    void addStands(const SeatBlock& block);
    void readAudience(const JsonNode* list, Show& show) const;
    void readWave(ObjectReader& reader, const JsonNode& node, Show& show) const;

    const Schema& schema_;
    Layout& layout_;
    Indices& groups_;
    Indices& walls_;
    Diagnostics& diagnostics_;
    Indices blocks_;
};

}  // namespace throng::authoring
