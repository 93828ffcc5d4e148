// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "authoring/layout.h"
#include "authoring/layout/object_reader.h"

namespace throng::authoring {

/// Reads floors, what joins them, and which of them something is on.
class LevelReader {
  public:
    LevelReader(const Schema& schema, Layout& layout, Diagnostics& diagnostics)
        : schema_(schema), layout_(layout), diagnostics_(diagnostics) {}

    void readLevel(const JsonNode& node);
    /// After all levels.
    void readLink(const JsonNode& node);
    /// The object's `level`.
    std::size_t levelOf(ObjectReader& reader) const;
    std::size_t levelNamed(const JsonNode& node) const;

  private:
    /// What is said of ground that moves.
    void readBelt(ObjectReader& reader, const JsonNode& node, Link& link) const;
    /// What is said of cabins.
    void readLift(ObjectReader& reader, const JsonNode& node, Link link);
    void readStops(ObjectReader& reader, const JsonNode& node, Lift& lift) const;
    void addBentLink(const Link& link, const std::vector<glm::dvec2>& path, const JsonNode& node);
    /// @param run m in plan, of its slopes
    void checkLink(const Link& link, double run, const JsonNode& node) const;

    const Schema& schema_;
    Layout& layout_;
    Diagnostics& diagnostics_;
    std::map<std::string, std::size_t> levels_, links_;
};

}  // namespace throng::authoring
