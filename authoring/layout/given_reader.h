// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "authoring/layout.h"
#include "authoring/layout/level_reader.h"
#include "authoring/layout/object_reader.h"

namespace throng::authoring {

/// Reads people whose ways are given; those in files are read later, by whoever knows files.
class GivenReader {
  public:
    /// @param groups ids of flows and formations, to which those of given people are added
    GivenReader(const Schema& schema, Layout& layout, LevelReader& levels, Indices& groups,
                Diagnostics& diagnostics)
        : schema_(schema), layout_(layout), levels_(levels), groups_(groups), diagnostics_(diagnostics) {}

    /// After levels, flows and formations.
    void read(const JsonNode& node);
    bool has(const std::string& id) const;

  private:
    void readSource(ObjectReader& reader, const JsonNode& node, GivenPeople& given);
    void readWay(const JsonNode& node, SchemaRule rule, GivenPeople& given);

    const Schema& schema_;
    Layout& layout_;
    LevelReader& levels_;
    Indices& groups_;
    Diagnostics& diagnostics_;
};

}  // namespace throng::authoring
