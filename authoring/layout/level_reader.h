// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "authoring/layout.h"
#include "authoring/layout/object_reader.h"

namespace throng::authoring {

/// Tells of links that climb more than their kind can, or hardly at all.
/// @param rise, run m, of all their slopes together; the latter in plan
void checkClimb(const Link& link, double rise, double run, const SourcePosition& where,
                Diagnostics& diagnostics);

/// m: of a flight of steps about as high; 0 of links that have none.
double riserOf(const Link& link);

/// m from one stop of a lift to the next, at the least: headroom.
inline constexpr double kLeastLiftRise = 2.2;

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
    /// Whether its ends are as high as the ground of a terrain, which is not known yet.
    bool isOnTerrain(const Link& link) const;

    const Schema& schema_;
    Layout& layout_;
    Diagnostics& diagnostics_;
    Indices levels_, links_;
};

}  // namespace throng::authoring
