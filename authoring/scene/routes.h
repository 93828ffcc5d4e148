// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/scene/fields.h"
#include "authoring/scene/ground.h"
#include "authoring/scene/rebase.h"

namespace throng::authoring {

/// Places as polygons, and the distance fields that lead to them. Every field is solved once, when first
/// asked for.
class Routes {
  public:
    Routes(const Layout& layout, const Rebase& rebase, Ground& ground);

    /// A place's outline in the scene frame: the area, or a strip of the road of this depth (m) at its end.
    LocalPolygon outline(const Place& place, float depth) const;
    static constexpr float kTargetDepth = 1.0f;  // m
    static constexpr float kEntryDepth = 4.0f;   // m

    /// Solves the fields of many destinations at once, on all processors.
    void solveAll(const std::vector<std::vector<Place>>& destinations, bool keep_to_roads);
    /// The field that leads to a place, for people who keep to the roads or do not.
    std::uint32_t fieldTo(const Place& place, bool keep_to_roads);
    /// The field that leads to whichever of the places is nearest.
    std::uint32_t fieldTo(const std::vector<Place>& places, bool keep_to_roads);
    /// The field that leads to the surroundings of a point: a rectangle of up to kSurroundings metres without
    /// a wall in it, so that the rest of the way is straight. Points near each other share it.
    /// @returns NO_INDEX where it would be one field too many
    std::uint32_t fieldTo(glm::vec2 point);
    static constexpr float kSurroundings = 32.0f;  // m

    /// Metres of walking, kUnreachable where no path leads.
    float reachable(std::uint32_t field, glm::vec2 from) const;
    float reachable(std::uint32_t field, const LocalPolygon& from) const;

    bool tooManyFields() const { return too_many_; }
    /// Somebody needs a field for which there is no room.
    void lackField() { too_many_ = true; }
    std::uint32_t fieldCount() const { return static_cast<std::uint32_t>(fields_.size()); }
    /// All cells, field after field.
    std::vector<gpu::FieldCell> cells() const;

    /// The coarse map and every field's distances on it, for routes that heed jams.
    Detours detours();

    /// What a layout calls the place, for messages.
    std::string name(const Place& place) const;

  private:
    std::vector<std::uint32_t> clearRectangle(glm::vec2 point);
    bool hasRoom() const;
    std::uint32_t solve(const std::vector<std::uint32_t>& targets, bool keep_to_roads, bool has_choice);
    std::uint32_t addField(std::shared_ptr<const Field> field, std::vector<std::uint32_t> targets,
                           bool keep_to_roads, bool has_choice);
    std::string keyOf(const std::vector<Place>& places, bool keep_to_roads) const;
    std::vector<std::uint32_t> cellsOf(const std::vector<Place>& places) const;

    const Layout& layout_;
    const Rebase& rebase_;
    Ground& ground_;
    FieldGrid grid_;
    std::map<std::string, std::uint32_t> known_;
    std::unordered_map<std::uint32_t, std::uint32_t> field_of_cell_;  // for points
    std::vector<std::shared_ptr<const Field>> fields_;
    std::vector<std::vector<std::uint32_t>> targets_;  // of each field: cells
    std::vector<bool> has_choice_;                     // of each field: leads to one of several places
    std::vector<bool> on_roads_;                       // of each field: for those who keep to the roads
    bool too_many_ = false;
};

}  // namespace throng::authoring
