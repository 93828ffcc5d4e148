// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
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
    /// A goal that is a point, and whether somebody can walk straight to it from the start: who does needs a
    /// field only when pushed out of its way.
    using PointGoal = std::pair<glm::vec2, bool>;
    /// Decides which points get fields of their own, and which share one with those beside them: all that are
    /// walked to straight, and others where they are too many. @returns how many fields that takes
    std::size_t plan(const std::vector<PointGoal>& goals);
    /// Solves the fields of all points of the plan, on all processors.
    void solvePlanned();
    /// The field that leads to a point of the plan, or to its surroundings, all clear, from where the rest of
    /// the way is straight. @returns NO_INDEX where it would be one field too many
    std::uint32_t fieldTo(const PointGoal& goal);

    /// Metres of walking, kUnreachable where no path leads.
    float reachable(std::uint32_t field, glm::vec2 from) const;
    float reachable(std::uint32_t field, const LocalPolygon& from) const;

    /// Whether a way leads from any of the points to a place. It takes a field that nobody keeps.
    bool leads(std::span<const glm::vec2> from, const Place& to);

    /// Where the way leads at first; zero where it is straight or unknown.
    glm::vec2 directionFrom(std::uint32_t field, glm::vec2 from) const;

    bool tooManyFields() const { return too_many_; }
    /// Somebody needs a field for which there is no room.
    void lackField() { too_many_ = true; }
    std::uint32_t fieldCount() const { return static_cast<std::uint32_t>(fields_.size()); }
    FieldStore store() const;

    /// The coarse map and every field's distances on it, for routes that heed jams.
    Detours detours();

    /// What a layout calls the place, for messages.
    std::string name(const Place& place) const;

  private:
    /// A field and what it leads to.
    struct Entry {
        std::shared_ptr<const Field> field;
        std::vector<std::uint32_t> targets;  // cells of the grid
        bool has_choice = false;             // leads to one of several places
        bool on_roads = false;               // for those who keep to them
    };
    using Points = std::vector<glm::vec2>;
    /// Points that share a field.
    struct Group {
        GoalBox bounds;
        std::optional<GoalBox> room;  // leads to all of this, and otherwise to the middle of the bounds
        Points points;
    };
    using Groups = std::vector<Group>;

    bool hasRoom() const;
    Groups groupsOf(const Points& points, float side, std::size_t most) const;
    std::uint32_t add(Entry entry);
    /// solve(i) fills the entry of a field in.
    void solveEach(const std::vector<std::uint32_t>& fields, const std::function<void(std::uint32_t)>& solve);
    std::shared_ptr<const Field> solve(const std::vector<Place>& places, bool keep_to_roads);
    Entry entryOf(const std::vector<Place>& places, bool keep_to_roads) const;
    std::string keyOf(const std::vector<Place>& places, bool keep_to_roads) const;

    const Layout& layout_;
    const Rebase& rebase_;
    Ground& ground_;
    std::map<std::string, std::uint32_t> known_;
    Groups groups_;  // planned
    std::map<std::tuple<float, float, bool>, std::uint32_t> field_of_point_;
    std::vector<Entry> fields_;
    bool too_many_ = false;
};

}  // namespace throng::authoring
