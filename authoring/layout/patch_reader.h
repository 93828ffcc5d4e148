// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "authoring/layout.h"
#include "authoring/layout/level_reader.h"
#include "authoring/layout/object_reader.h"

namespace throng::authoring {

/// Reads ground that people avoid, or walk on at another pace.
class PatchReader {
  public:
    PatchReader(const Schema& schema, Layout& layout, LevelReader& levels, Diagnostics& diagnostics)
        : schema_(schema), layout_(layout), levels_(levels), diagnostics_(diagnostics) {}

    /// After the settings and the levels.
    void read(const JsonNode& node);

  private:
    void check(const JsonNode& node, const Patch& patch) const;

    const Schema& schema_;
    Layout& layout_;
    LevelReader& levels_;
    Diagnostics& diagnostics_;
    Indices patches_;
};

}  // namespace throng::authoring
