// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/terrain_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "authoring/scene/raster.h"

namespace throng::authoring {
namespace {

constexpr float kOverTheEdge =
    1.0f;  // m: so far off the terrain, ground is taken to go on as it does at its edge
constexpr float kSteepest = 1.0f;  // rise over run: 45 degrees
constexpr float kStorey = 1.0f;    // m between two faces that make two storeys
constexpr double kMostSamples = 400'000.0;
constexpr float kSample = 0.5f;          // m
constexpr double kWorthTelling = 0.001;  // share of the ground that is walked on

bool hasGround(const Terrain& terrain, glm::vec2 point) {
    if (terrain.groundAt(point)) return true;
    for (const float reach : {0.5f * kOverTheEdge, kOverTheEdge})
        for (int i = 0; i < 8; ++i) {
            const float angle = 0.785398f * static_cast<float>(i);
            if (terrain.groundAt(point + reach * glm::vec2(std::cos(angle), std::sin(angle)))) return true;
        }
    return false;
}

/// Points along a line, at most `spacing` apart, both ends among them.
template <class Visit>
void walkAlong(glm::dvec2 a, glm::dvec2 b, double spacing, Visit visit) {
    const int pieces = std::max(1, static_cast<int>(std::ceil(glm::length(b - a) / spacing)));
    for (int i = 0; i <= pieces; ++i)
        visit(glm::mix(a, b, static_cast<double>(i) / pieces));
}

class TerrainChecker {
  public:
    TerrainChecker(const Layout& layout, const Rebase& rebase, const WalkGeometry& geometry,
                   const TerrainMesh& mesh, const Terrain& terrain, Diagnostics& diagnostics)
        : layout_(layout),
          settings_(*layout.terrain),
          rebase_(rebase),
          geometry_(geometry),
          mesh_(mesh),
          terrain_(terrain),
          diagnostics_(diagnostics) {}

    void check() {
        if (terrain_.isEmpty()) {
            tellWhereItLies();
            return;
        }
        for (const Road& road : layout_.roads)
            checkRoad(road);
        for (const Area& area : layout_.areas)
            checkArea(area);
        for (const Formation& formation : layout_.formations)
            checkFormation(formation);
        for (const GivenPeople& given : layout_.given)
            checkGiven(given);
        checkWalkedGround();
    }

  private:
    std::string extent() const {
        glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
        for (const glm::dvec3& p : mesh_.positions)
            for (int axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], p[axis]);
                high[axis] = std::max(high[axis], p[axis]);
            }
        return fmt::format("x from {:.2f} to {:.2f}, y from {:.2f} to {:.2f}, z from {:.2f} to {:.2f} m",
                           low.x, high.x, low.y, high.y, low.z, high.z);
    }

    void tellWhereItLies() const {
        diagnostics_.error(
            settings_.file_where,
            fmt::format("no face of `{}` that looks up lies where this layout is", settings_.file),
            fmt::format("the terrain covers {}: set its `offset` or `scale`; or its faces look down",
                        extent()));
    }

    void complain(const SourcePosition& where, const std::string& what, glm::dvec2 point) const {
        diagnostics_.error(
            where,
            fmt::format("{}: there is no ground of the terrain at ({:.2f}, {:.2f})", what, point.x, point.y),
            fmt::format("the terrain covers {}: move the one or the other", extent()));
    }

    bool isOver(glm::dvec2 world) const { return hasGround(terrain_, rebase_.local(world)); }

    /// They go where they went, ground or not.
    void checkGiven(const GivenPeople& given) const {
        for (const std::vector<GivenPoint>& way : given.ways)
            for (const GivenPoint& point : way) {
                if (isOver(point.place)) continue;
                diagnostics_.warning(
                    given.where,
                    fmt::format("given `{}`: there is no ground of the terrain at ({:.2f}, {:.2f})", given.id,
                                point.place.x, point.place.y),
                    fmt::format("the terrain covers {}: set their `offset`", extent()));
                return;
            }
    }

    void checkRoad(const Road& road) const {
        for (std::size_t i = 0; i + 1 < road.centreline.size(); ++i) {
            bool told = false;
            walkAlong(road.centreline[i], road.centreline[i + 1], 1.0, [&](glm::dvec2 point) {
                if (told || isOver(point)) return;
                complain(road.where, fmt::format("road `{}`", road.id), point);
                told = true;
            });
            if (told) return;
        }
    }

    void checkArea(const Area& area) const {
        for (std::size_t i = 0; i < area.polygon.size(); ++i) {
            bool told = false;
            walkAlong(area.polygon[i], area.polygon[(i + 1) % area.polygon.size()], 1.0,
                      [&](glm::dvec2 point) {
                          if (told || isOver(point)) return;
                          complain(area.where, fmt::format("area `{}`", area.id), point);
                          told = true;
                      });
            if (told) return;
        }
    }

    void checkFormation(const Formation& formation) const {
        const FormationPlaces places = formationPlaces(formation, layout_.simulation.seed);
        const auto* list = std::get_if<ListFormation>(&formation.shape);
        for (const auto& [points, what] : {std::pair{&places.positions, "person {} stands"},
                                           {&places.goals, "the goal of person {} lies"}})
            for (std::size_t i = 0; i < points->size(); ++i) {
                if (isOver((*points)[i])) continue;
                complain(list ? list->agents[i].where : formation.where,
                         fmt::format("formation `{}`: {} off the terrain", formation.id,
                                     fmt::format(fmt::runtime(what), i)),
                         (*points)[i]);
                return;
            }
        if (!list) return;
        for (std::size_t i = 0; i < list->agents.size(); ++i)
            for (const Waypoint& waypoint : list->agents[i].via)
                if (!isOver(waypoint.point)) {
                    complain(waypoint.where,
                             fmt::format("formation `{}`: the way of person {} leads off the terrain",
                                         formation.id, i),
                             waypoint.point);
                    return;
                }
    }

    struct Finding {
        std::size_t count = 0;
        glm::dvec2 first{0.0};
        float worst = 0.0f;
        void add(glm::dvec2 point, float value) {
            if (count++ == 0) first = point;
            worst = std::max(worst, value);
        }
    };

    /// Samples of roads and areas; of the whole layout where there are none.
    void checkWalkedGround() const {
        Finding holes, storeys, steep;
        std::size_t samples = 0;
        const FieldGrid grid = makeGrid(geometry_, kSample, kMostSamples);
        const bool anywhere = geometry_.roads.empty() && geometry_.areas.empty();
        const std::vector<bool> walked = walkedCells(grid);
        for (std::uint32_t y = 0; y < grid.height; ++y)
            for (std::uint32_t x = 0; x < grid.width; ++x) {
                const glm::vec2 point = cellCentre(grid, x, y);
                if (!anywhere && !walked[std::size_t{y} * grid.width + x]) continue;
                const std::optional<float> ground = terrain_.groundAt(point);
                if (anywhere && !ground) continue;
                ++samples;
                const glm::dvec2 world = rebase_.origin() + glm::dvec2(point);
                if (!ground && !hasGround(terrain_, point)) holes.add(world, 0.0f);
                if (const float apart = terrain_.storeysAt(point); apart > kStorey) storeys.add(world, apart);
                if (const float slope = glm::length(terrain_.slopeAt(point)); slope > kSteepest)
                    steep.add(world, slope);
            }
        const auto tell = [&](const Finding& finding, const std::string& what, const std::string& hint) {
            const double share =
                static_cast<double>(finding.count) / static_cast<double>(std::max<std::size_t>(samples, 1));
            if (share < kWorthTelling) return;
            diagnostics_.warning(
                settings_.where,
                fmt::format("{} on {:.1f} % of the ground that people walk on, first at ({:.2f}, {:.2f})",
                            what, 100.0 * share, finding.first.x, finding.first.y),
                hint);
        };
        tell(holes, "there is a hole in the terrain",
             "people there stand at the height of the ground beside it");
        tell(storeys,
             fmt::format("two faces of the terrain lie above each other, up to {:.1f} m apart,",
                         storeys.worst),
             settings_.highest ? "people stand on the highest: write \"surface\": \"lowest\" for the other, "
                                 "or export the ground alone (`node`)"
                               : "people stand on the lowest: write \"surface\": \"highest\" for the other");
        tell(steep,
             fmt::format("the terrain is steeper than 45 degrees (up to {:.0f})",
                         57.29578f * std::atan(steep.worst)),
             "people climb it very slowly; put a wall along its edge to keep them off");
    }

    std::vector<bool> walkedCells(const FieldGrid& grid) const {
        std::vector<bool> walked(cellCount(grid), false);
        for (const LocalRoad& road : geometry_.roads)
            markRoad(grid, road, 0.0f, walked);
        for (const LocalPolygon& area : geometry_.areas)
            visitInside(grid, area, [&](std::uint32_t cell, glm::vec2) { walked[cell] = true; });
        return walked;
    }

    const Layout& layout_;
    const TerrainSettings& settings_;
    const Rebase& rebase_;
    const WalkGeometry& geometry_;
    const TerrainMesh& mesh_;
    const Terrain& terrain_;
    Diagnostics& diagnostics_;
};

}  // namespace

void checkTerrain(const Layout& layout, const Rebase& rebase, const WalkGeometry& geometry,
                  const TerrainMesh& mesh, const Terrain& terrain, Diagnostics& diagnostics) {
    TerrainChecker(layout, rebase, geometry, mesh, terrain, diagnostics).check();
}

bool areLevelsComplete(const Layout& layout, Diagnostics& diagnostics) {
    for (const Level& level : layout.levels) {
        if (level.is_landing) continue;
        if (layout.terrain && !level.floor.empty())
            diagnostics.error(
                level.where,
                fmt::format("level `{}`: a layout with a terrain has no floors of its own", level.id),
                R"(name a ground of the terrain by a place on it, "at": [x, y, z])");
        else if (layout.terrain && !level.at)
            diagnostics.error(
                level.where,
                fmt::format("level `{}` names no ground of the terrain: `at` is missing", level.id),
                "give a place on it, [x, y, z] in metres");
        else if (!layout.terrain && level.floor.empty())
            diagnostics.error(level.where, fmt::format("level `{}` has no `floor`", level.id),
                              level.at
                                  ? "give it one, or the layout a `terrain`: `at` names a ground of a terrain"
                                  : "its outline, points [x, y] in metres");
        else if (!layout.terrain && level.at)
            diagnostics.error(
                level.where,
                fmt::format("level `{}`: `at` names a ground of a terrain, and there is none", level.id),
                "leave it out, or give the layout a `terrain`");
    }
    if (layout.terrain && layout.terrain->is_single && !layout.levels.empty())
        diagnostics.error(layout.terrain->where,
                          "a terrain of which people walk on one `surface` has no levels",
                          "leave out `surface`, or the levels");
    return !diagnostics.hasErrors();
}

glm::dvec2 groundAlong(const Wall& wall, const Rebase& rebase, const Terrain& terrain) {
    glm::dvec2 range(std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest());
    const std::size_t pieces = wall.points.size() - (wall.closed ? 0 : 1);
    for (std::size_t i = 0; i < pieces; ++i)
        walkAlong(wall.points[i], wall.points[(i + 1) % wall.points.size()], 0.5, [&](glm::dvec2 point) {
            const double height = double{terrain.heightAt(rebase.local(point))};
            range = {std::min(range.x, height), std::max(range.y, height)};
        });
    return range;
}

}  // namespace throng::authoring
