// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/ways_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "authoring/scene/raster.h"

namespace throng::authoring {
namespace {

constexpr float kCell = 0.05f;    // m, of small sites
constexpr double kCells = 1.0e6;  // as many as cost no time worth speaking of
constexpr float kNearby = 0.2f;   // m beyond a body: as far as a start or a goal may be from where it fits
constexpr std::size_t kMostKinds = 12;    // of bodies and closed gates that are looked at
constexpr std::size_t kMostPoints = 400;  // goals of a formation's people that are looked at, evenly chosen
constexpr std::uint32_t kNone = gpu::NO_INDEX;

using Cells = std::vector<std::uint32_t>;

/// Who walks together, for this: the widest body, and the gates that are closed for all of the group's time.
struct Kind {
    int radius = 0;  // cm
    std::vector<std::uint32_t> closed_gates;
    bool operator<(const Kind& other) const {
        return std::tie(radius, closed_gates) < std::tie(other.radius, other.closed_gates);
    }
};

/// Ground in pieces: cells with the same number can be walked to from each other.
struct Pieces {
    std::vector<std::uint32_t> of;  // kNone where no body can be
};

/// Ground that people want to get to.
struct Goal {
    Cells cells;
    std::map<const Pieces*, std::vector<std::uint32_t>> pieces{};  // that it lies in, in order
};

class WaysChecker {
  public:
    WaysChecker(const Layout& layout, const Rebase& rebase, const WalkGeometry& geometry, Routes& routes,
                const Scene& scene, Diagnostics& diagnostics)
        : layout_(layout),
          rebase_(rebase),
          geometry_(geometry),
          routes_(routes),
          scene_(scene),
          diagnostics_(diagnostics),
          grid_(makeGrid(geometry, kCell, kCells)) {}

    void check() {
        for (std::size_t i = 0; i < layout_.flows.size(); ++i)
            checkFlow(layout_.flows[i], i);
        for (std::size_t i = 0; i < layout_.formations.size(); ++i)
            checkFormation(layout_.formations[i], layout_.flows.size() + i);
        tell();
    }

  private:
    bool isGate(const gpu::WallSegment& segment) const {
        return !layout_.walls[segment.wall].toggles.empty();
    }

    Kind kindOf(std::size_t group, double start) const {
        Kind kind;
        const gpu::SpawnQueue& queue = scene_.queues[group];
        for (std::uint32_t row = queue.first_row; row < queue.first_row + queue.row_count; ++row) {
            const gpu::Person& person = scene_.people[row];
            // Who is broader than deep goes sideways where that helps.
            const float thickness = person.radius - std::abs(person.half_axis);
            kind.radius = std::max(kind.radius, static_cast<int>(std::floor(100.0f * thickness)));
        }
        for (std::uint32_t i = 0; i < layout_.walls.size(); ++i)
            if (const Wall& wall = layout_.walls[i]; !wall.toggles.empty() && !opens(wall, start))
                kind.closed_gates.push_back(i);
        return kind;
    }

    /// Whether a gate is open at any time from then on.
    bool opens(const Wall& wall, double start) const {
        const auto is_open_later = [&](double at) {
            return at > start && at <= layout_.simulation.duration && wall.isOpen(at);
        };
        return wall.isOpen(start) || std::ranges::any_of(wall.toggles, is_open_later);
    }

    void checkFlow(const Flow& flow, std::size_t group) {
        if (flow.behaviour) return;
        if (scene_.queues[group].row_count == 0) return;
        const Kind kind = kindOf(group, flow.start > 0.0 ? flow.start : -layout_.simulation.warmup);
        Cells from = cellsInPolygon(grid_, routes_.outline(flow.from, Routes::kEntryDepth));
        for (const BehaviourState& stop : flow.via) {
            checkLeg(flow.id, kind, from, stop.to);
            from.clear();  // those go on from there
            for (const Place& place : stop.to.places)
                from.insert(from.end(), goalAt(place).cells.begin(), goalAt(place).cells.end());
        }
        checkLeg(flow.id, kind, from, flow.to);
    }

    void checkFormation(const Formation& formation, std::size_t group) {
        if (formation.behaviour) return;
        const gpu::SpawnQueue& queue = scene_.queues[group];
        if (queue.row_count == 0) return;
        const Kind kind = kindOf(group, formation.start > 0.0 ? formation.start : -layout_.simulation.warmup);
        const auto* grid = std::get_if<GridFormation>(&formation.shape);
        const auto* place = grid ? std::get_if<Destination>(&grid->goal) : nullptr;
        const float body = 0.01f * static_cast<float>(kind.radius) + kNearby;
        const std::uint32_t stride = 1 + queue.row_count / static_cast<std::uint32_t>(kMostPoints);
        for (std::uint32_t i = 0; i < queue.row_count; i += stride) {
            const Cells from = cellsNear(scene_.people[queue.first_row + i].spawn_position, body);
            const auto* list = std::get_if<ListFormation>(&formation.shape);
            const Destination* own = list && list->agents[i].to ? &*list->agents[i].to : nullptr;
            if (place || own) {
                checkLeg(formation.id, kind, from, own ? *own : *place);
            } else {
                Goal goal{cellsNear(scene_.goals[queue.first_row + i],
                                    body + static_cast<float>(formation.goal_tolerance))};
                follow(formation.id, kind, from, goal);
            }
        }
    }

    Goal& goalAt(const Place& place) {
        const auto [goal, is_new] = goals_.try_emplace({place.kind, place.index, place.number});
        if (is_new) goal->second.cells = cellsInPolygon(grid_, routes_.outline(place, Routes::kTargetDepth));
        return goal->second;
    }

    Cells cellsNear(glm::vec2 point, float reach) const {
        Cells cells;
        visitBox(grid_, point - reach, point + reach, [&](std::uint32_t cell, glm::vec2 centre) {
            if (glm::distance(centre, point) <= reach) cells.push_back(cell);
        });
        return cells;
    }

    void checkLeg(const std::string& who, const Kind& kind, const Cells& from, const Destination& to) {
        for (const Place& place : to.places)
            if (to.kind != Destination::Kind::nearest)
                follow(who, kind, from, goalAt(place));
            else
                checkOneOfSeveral(who, kind, from, place);
    }

    /// Nobody notices at a route to the nearest of several places that one of them cannot be had.
    void checkOneOfSeveral(const std::string& who, const Kind& kind, const Cells& from, const Place& place) {
        constexpr std::size_t kMostShut = 20;  // each takes a field
        const std::string name = routes_.name(place);
        const auto known = std::ranges::find(shut_, name, &Shut::name);
        if (known != shut_.end() && std::ranges::find(known->who, who) != known->who.end()) return;
        if (follow(who, kind, from, goalAt(place)) || shut_.size() == kMostShut) return;
        std::vector<glm::vec2> starts;
        for (const std::uint32_t cell : from)
            starts.push_back(cellCentre(grid_, cell % grid_.width, cell / grid_.width));
        if (routes_.leads(starts, place)) return;  // these cells may be larger than a door
        const auto end = known != shut_.end() ? known : shut_.insert(known, {place.where, name, {}});
        end->who.push_back(who);
    }

    static const std::vector<std::uint32_t>& piecesOf(Goal& goal, const Pieces& ground) {
        const auto [known, is_new] = goal.pieces.try_emplace(&ground);
        std::vector<std::uint32_t>& pieces = known->second;
        if (!is_new) return pieces;
        for (const std::uint32_t cell : goal.cells)
            if (ground.of[cell] != kNone) pieces.push_back(ground.of[cell]);
        std::ranges::sort(pieces);
        pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
        return pieces;
    }

    /// Tells of ways that are none for these. @returns whether any leads there, whoever walks it
    bool follow(const std::string& who, const Kind& kind, const Cells& from, Goal& to) {
        const Pieces* narrow = piecesFor(kind);
        if (!narrow) return true;
        const std::vector<std::uint32_t>& reached = piecesOf(to, *narrow);
        bool starts = false;
        for (const std::uint32_t cell : from) {
            const std::uint32_t piece = narrow->of[cell];
            if (piece == kNone) continue;
            if (std::ranges::binary_search(reached, piece)) return true;
            starts = true;
        }
        // Starts and goals without room are told elsewhere.
        if (!starts || reached.empty()) return true;
        const auto end = endOfWay(*narrow, from, to.cells);
        if (end) remember(who, kind, *end);
        return end.has_value();
    }

    /// Where the shortest way of the smallest body, all gates open, first is no way for these.
    std::optional<std::uint32_t> endOfWay(const Pieces& narrow, const Cells& from, const Cells& to) {
        const std::vector<bool>& free = widestGround();
        std::vector<std::uint32_t> next(cellCount(grid_), kNone);
        Cells front;
        for (const std::uint32_t cell : to)
            if (free[cell] && next[cell] == kNone) {
                next[cell] = cell;
                front.push_back(cell);
            }
        for (std::size_t i = 0; i < front.size(); ++i)
            visitNeighbours(grid_, front[i], [&](std::uint32_t beside) {
                if (!free[beside] || next[beside] != kNone) return;
                next[beside] = front[i];
                front.push_back(beside);
            });
        for (std::uint32_t cell : from) {
            if (narrow.of[cell] == kNone || next[cell] == kNone) continue;
            while (narrow.of[cell] != kNone && next[cell] != cell)
                cell = next[cell];
            return cell;
        }
        return std::nullopt;  // no way at all: an error of its own, or one of several places
    }

    float clearanceFor(float radius) const {
        return std::max(0.6f * grid_.cell_size, radius - 0.71f * grid_.cell_size);
    }

    void block(std::vector<bool>& free, const gpu::WallSegment& wall, float clearance) const {
        visitAlong(grid_, wall.a, wall.b, clearance + wall.half_thickness,
                   [&](std::uint32_t cell, glm::vec2 centre) {
                       if (segmentDistance(centre, wall.a, wall.b) - wall.half_thickness < clearance)
                           free[cell] = false;
                   });
    }

    std::vector<bool> groundFor(float clearance) const {
        std::vector<bool> free(cellCount(grid_), true);
        for (const gpu::WallSegment& wall : geometry_.walls)
            block(free, wall, clearance);
        for (const LocalPolygon& solid : geometry_.solids)
            visitInside(grid_, solid, [&](std::uint32_t cell, glm::vec2) { free[cell] = false; });
        return free;
    }

    const std::vector<bool>& widestGround() {
        if (widest_.empty()) widest_ = groundFor(0.6f * grid_.cell_size);
        return widest_;
    }

    /// Null where there are too many kinds to look at all.
    const Pieces* piecesFor(const Kind& kind) {
        const auto known = pieces_.find(kind);
        if (known != pieces_.end()) return &known->second;
        if (pieces_.size() == kMostKinds) return nullptr;
        const float clearance = clearanceFor(0.01f * static_cast<float>(kind.radius));
        std::vector<bool> free = groundFor(clearance);
        for (const gpu::WallSegment& segment : scene_.wall_segments)
            if (std::ranges::binary_search(kind.closed_gates, segment.wall)) block(free, segment, clearance);
        return &pieces_.emplace(kind, piecesOf(free)).first->second;
    }

    Pieces piecesOf(const std::vector<bool>& free) const {
        Pieces pieces{std::vector<std::uint32_t>(cellCount(grid_), kNone)};
        std::uint32_t number = 0;
        Cells front;
        for (std::uint32_t first = 0; first < pieces.of.size(); ++first) {
            if (!free[first] || pieces.of[first] != kNone) continue;
            pieces.of[first] = number;
            front.assign(1, first);
            while (!front.empty()) {
                const std::uint32_t cell = front.back();
                front.pop_back();
                visitNeighbours(grid_, cell, [&](std::uint32_t beside) {
                    if (!free[beside] || pieces.of[beside] != kNone) return;
                    pieces.of[beside] = number;
                    front.push_back(beside);
                });
            }
            ++number;
        }
        return pieces;
    }

    /// A place where ways end, and whose.
    struct End {
        glm::vec2 at;
        std::uint32_t wall;
        bool is_gate;
        int radius;
        std::vector<std::string> who;
    };

    /// One of several places to which no way leads, and for whom.
    struct Shut {
        SourcePosition where;
        std::string name;
        std::vector<std::string> who;
    };

    static std::string namesOf(const std::vector<std::string>& who) {
        return fmt::format("`{}`{}", who.front(),
                           who.size() > 1 ? fmt::format(" and of {} more groups", who.size() - 1) : "");
    }

    void remember(const std::string& who, const Kind& kind, std::uint32_t cell) {
        const glm::vec2 at = cellCentre(grid_, cell % grid_.width, cell / grid_.width);
        const gpu::WallSegment* nearest = nullptr;
        float least = kUnreachable;
        for (const gpu::WallSegment& segment : scene_.wall_segments) {
            if (isGate(segment) && !std::ranges::binary_search(kind.closed_gates, segment.wall)) continue;
            const float distance = segmentDistance(at, segment.a, segment.b) - segment.half_thickness;
            if (distance >= least) continue;
            least = distance;
            nearest = &segment;
        }
        if (!nearest) return;
        const bool is_gate = isGate(*nearest);
        constexpr float kSamePlace = 1.5f;  // m: as wide as a narrow door with its posts
        auto end = std::ranges::find_if(ends_, [&](const End& known) {
            return is_gate ? known.is_gate && known.wall == nearest->wall
                           : !known.is_gate && glm::distance(known.at, at) < kSamePlace;
        });
        if (end == ends_.end()) end = ends_.insert(end, {at, nearest->wall, is_gate, kind.radius, {}});
        if (std::ranges::find(end->who, who) == end->who.end()) end->who.push_back(who);
    }

    void tell() {
        for (const Shut& shut : shut_)
            diagnostics_.warning(shut.where,
                                 fmt::format("nobody of {} can walk to `{}`: all go to the other places of "
                                             "`nearest`",
                                             namesOf(shut.who), shut.name),
                                 "look for walls across the way, doors narrower than a body, and one-way "
                                 "roads that point the other way");
        for (const End& end : ends_) {
            const glm::dvec2 at = rebase_.origin() + glm::dvec2(end.at);
            const Wall& wall = layout_.walls[end.wall];
            const std::string who = namesOf(end.who);
            if (end.is_gate)
                diagnostics_.warning(wall.where,
                                     fmt::format("the way of {} ends at the gate `{}`, at [{:.2f}, {:.2f}]: "
                                                 "it is closed for all their time",
                                                 who, wall.id, at.x, at.y),
                                     "let an event open it before the shot ends, or lead them another way");
            else
                diagnostics_.warning(wall.where,
                                     fmt::format("the way of {} ends at [{:.2f}, {:.2f}]: the widest of them "
                                                 "has a radius of {:.2f} m, and "
                                                 "does not fit through there",
                                                 who, at.x, at.y, 0.01 * end.radius),
                                     "make the opening wider than the widest body, or the bodies smaller "
                                     "(`people`, `radius`)");
        }
    }

    const Layout& layout_;
    const Rebase& rebase_;
    const WalkGeometry& geometry_;
    Routes& routes_;
    const Scene& scene_;
    Diagnostics& diagnostics_;
    FieldGrid grid_;
    std::vector<bool> widest_;
    std::map<Kind, Pieces> pieces_;
    std::map<std::tuple<Place::Kind, std::size_t, std::size_t>, Goal> goals_;
    std::vector<End> ends_;
    std::vector<Shut> shut_;
};

}  // namespace

void checkWays(const Layout& layout, const Rebase& rebase, const WalkGeometry& geometry, Routes& routes,
               const Scene& scene, Diagnostics& diagnostics) {
    if (!scene.wall_segments.empty())
        WaysChecker(layout, rebase, geometry, routes, scene, diagnostics).check();
}

}  // namespace throng::authoring
