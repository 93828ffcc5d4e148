// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/itineraries.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <set>
#include <utility>

#include "authoring/scene/behaviours.h"
#include "authoring/scene/raster.h"
#include "authoring/scene/standing.h"
#include "authoring/scene/traffic.h"
#include "authoring/scene/walls.h"

namespace throng::authoring {
namespace {

constexpr float kStandTolerance = 0.3f;  // m

float edgeDistance(const LocalPolygon& polygon, glm::vec2 point) {
    float least = kUnreachable;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
        least = std::min(least, segmentDistance(point, polygon[j], polygon[i]));
    return least;
}

}  // namespace

Itineraries::Spread::Spread(LocalPolygon outline, const WalkGeometry& geometry, float clearance, float inset)
    : outline_(std::move(outline)), geometry_(&geometry), clearance_(clearance), inset_(inset) {}

std::optional<glm::vec2> Itineraries::Spread::next() {
    constexpr int kTries = 16'384;
    const Box box = boundsOf(outline_, 0.0f);
    for (int i = 1; i <= kTries; ++i) {
        if (i % 512 == 0) inset_ *= 0.5f;
        x_ = std::fmod(x_ + 0.7548776662466927, 1.0);
        y_ = std::fmod(y_ + 0.5698402909980532, 1.0);
        glm::vec2 within =
            (box.upper - box.lower) * glm::vec2(static_cast<float>(x_), static_cast<float>(y_));
        if (geometry_->charts) within = snapped(within);
        const glm::vec2 point = box.lower + within;
        if (geometry_->charts && !geometry_->charts->isGround(point)) continue;
        if (insidePolygon(outline_, point) && edgeDistance(outline_, point) >= inset_ &&
            wallDepth(*geometry_, point, clearance_) <= 0.0f)
            return point;
    }
    return std::nullopt;
}

Itineraries::Itineraries(const Layout& layout, const Rebase& rebase, const WalkGeometry& geometry,
                         Routes& routes, Diagnostics& diagnostics, Scene& scene)
    : layout_(layout),
      rebase_(rebase),
      geometry_(geometry),
      routes_(routes),
      diagnostics_(diagnostics),
      scene_(scene) {}

/// What people who do not keep to roads, and who do, go to.
std::array<Itineraries::Destinations, 2> Itineraries::wanted(const Layout& layout) {
    std::array<Destinations, 2> wanted;
    const auto want = [&](const Destination& to, bool keep_to_roads) {
        Destinations& list = wanted[keep_to_roads ? 1 : 0];
        if (to.kind == Destination::Kind::nearest) list.push_back(to.places);
        if (to.kind != Destination::Kind::nearest)
            for (const Place& place : to.places)
                list.push_back({place});
    };
    for (const Flow& flow : layout.flows) {
        for (const BehaviourState& stop : flow.via)
            want(stop.to, keepsToRoads(layout));
        if (!flow.behaviour) want(flow.to, keepsToRoads(layout));
    }
    BehaviourTables::destinations(layout, want);
    for (const Formation& formation : layout.formations) {
        if (const auto* grid = std::get_if<GridFormation>(&formation.shape))
            if (const auto* to = std::get_if<Destination>(&grid->goal)) want(*to, false);
        if (const auto* list = std::get_if<ListFormation>(&formation.shape))
            for (const ListedAgent& agent : list->agents)
                if (agent.to) want(*agent.to, false);
    }
    return wanted;
}

std::size_t Itineraries::destinationCount(const Layout& layout) {
    std::size_t count = 0;
    for (const Destinations& list : wanted(layout)) {
        std::set<std::vector<std::pair<Place::Kind, std::size_t>>> different;
        for (const std::vector<Place>& places : list) {
            std::vector<std::pair<Place::Kind, std::size_t>> key;
            for (const Place& place : places)
                key.emplace_back(place.kind, place.index);
            different.insert(key);
        }
        count += different.size();
    }
    return count;
}

void Itineraries::prepare() {
    const std::array<Destinations, 2> lists = wanted(layout_);
    for (const bool keep_to_roads : {false, true})
        routes_.solveAll(lists[keep_to_roads ? 1 : 0], keep_to_roads);
}

bool Itineraries::isShared(const Journey& journey) {
    for (const BehaviourState& stop : journey.stops)
        if (stop.stops() || stop.for_good || stop.to.kind == Destination::Kind::choose) return false;
    return true;
}

std::uint32_t Itineraries::fieldTo(const Destination& to, bool keep_to_roads, std::size_t choice) {
    return to.kind == Destination::Kind::nearest ? routes_.fieldTo(to.places, keep_to_roads)
                                                 : routes_.fieldTo(to.places[choice], keep_to_roads);
}

void Itineraries::check(const Journey& journey, const std::string& start, std::vector<LocalPolygon> from) {
    std::string before = start;
    for (const BehaviourState& stop : journey.stops) {
        std::vector<LocalPolygon> reached;
        for (std::size_t i = 0; i < stop.to.places.size(); ++i) {
            const Place& place = stop.to.places[i];
            const std::uint32_t field = fieldTo(stop.to, journey.keep_to_roads, i);
            reached.push_back(routes_.outline(place, Routes::kTargetDepth));
            for (const LocalPolygon& outline : from) {
                if (routes_.reachable(field, outline) != kUnreachable) continue;
                diagnostics_.error(place.where.line ? place.where : journey.where,
                                   fmt::format("{}: nobody can walk from {} to `{}`", journey.traveller,
                                               before, routes_.name(place)),
                                   "look for walls across the way, doors narrower than a body, and one-way "
                                   "roads that point the other way");
                break;
            }
            if (stop.to.kind == Destination::Kind::nearest) break;  // one field for all of them
        }
        before = fmt::format("`{}`", routes_.name(stop.to.places.front()));
        from = std::move(reached);
        const LocalPolygon area = routes_.outline(stop.to.places.front(), Routes::kTargetDepth);
        for (const glm::dvec2 point : stop.line)
            if (!insidePolygon(area, rebase_.local(point)))
                diagnostics_.error(
                    stop.where,
                    fmt::format("{}: the line at `{}` leaves its area at [{:.6g}, {:.6g}]", journey.traveller,
                                routes_.name(stop.to.places.front()), point.x, point.y),
                    "the whole line has to lie in the area of its stop");
    }
}

std::size_t Itineraries::chosen(const Destination& to, const GroupRandom& random, std::uint64_t leader,
                                std::uint64_t draw) const {
    if (to.kind != Destination::Kind::choose) return 0;
    double left = 0.0;
    for (const double weight : to.weights)
        left += weight;
    left *= random.unit(leader, Purpose::choice, draw);
    for (std::size_t i = 0; i < to.weights.size(); ++i) {
        if (left < to.weights[i]) return i;
        left -= to.weights[i];
    }
    return to.weights.size() - 1;
}

std::uint32_t Itineraries::appendStages(const Journey& journey, const GroupRandom& random,
                                        const Traveller& traveller) {
    std::uint64_t draw = journey.first_draw;
    for (const BehaviourState& stop : journey.stops) {
        const std::size_t choice = chosen(stop.to, random, traveller.leader, draw);
        const Place& place = stop.to.places[choice];
        const std::uint32_t field = fieldTo(stop.to, journey.keep_to_roads, choice);
        const double wait = stop.for_good ? double{gpu::DWELL_FOR_GOOD}
                            : stop.lasts  ? random.draw(*stop.lasts, traveller.leader, Purpose::wait, draw)
                                          : 0.0;
        ++draw;
        if (wait > 0.0 && stop.to.kind != Destination::Kind::nearest) {
            scene_.stages.push_back(stopStage(stop, place, field, wait, traveller));
            continue;
        }
        gpu::Stage stage{};
        stage.point = stage.facing = middleOf(routes_.outline(place, Routes::kTargetDepth));
        stage.tolerance = kPassTolerance;
        stage.field = field;
        stage.dwell = static_cast<float>(wait);
        stage.line = gpu::NO_INDEX;
        stage.activity = gpu::ACTIVITY_STAND;
        scene_.stages.push_back(stage);
    }
    for (std::size_t i = 1; i < journey.stops.size(); ++i) {
        const gpu::Stage& next = scene_.stages[scene_.stages.size() - i];
        gpu::Stage& stage = scene_.stages[scene_.stages.size() - i - 1];
        const float leg = routes_.reachable(next.field & ~gpu::FIELD_THEN_POINT, stage.point);
        stage.beyond = next.beyond + (leg < kUnreachable ? leg : 0.0f);
    }
    return static_cast<std::uint32_t>(journey.stops.size());
}

gpu::Stage Itineraries::stopStage(const BehaviourState& stop, const Place& place, std::uint32_t field,
                                  double wait, const Traveller& traveller) {
    gpu::Stage stage{};
    glm::vec2 middle(0.0f);
    stage.point = spotFor(place, traveller, middle);
    stage.facing = stop.facing ? rebase_.local(*stop.facing) : middle;
    stage.tolerance = kStandTolerance;
    stage.field = field | gpu::FIELD_THEN_POINT;
    stage.dwell = static_cast<float>(wait);
    stage.line = gpu::NO_INDEX;
    stage.activity = static_cast<std::uint32_t>(stop.activity);
    stage.flags = gpu::STAGE_ANYWHERE | gpu::STAGE_IN_AREA;
    if (stop.does == BehaviourState::Does::queue) {
        stage.line = lineFor(stop.line, stop.spacing);
        stage.point = rebase_.local(stop.line.front());
        stage.facing = stop.facing ? stage.facing : stage.point;
        stage.flags = 0;
        ++scene_.lines[stage.line].ticket_count;
        ++scene_.ticket_count;
    }
    return stage;
}

/// A party stands in a ring round one spot and looks at its middle; who is alone looks to the middle of the
/// place.
glm::vec2 Itineraries::spotFor(const Place& place, const Traveller& traveller, glm::vec2& middle) {
    const std::string name = routes_.name(place);
    const LocalPolygon outline = routes_.outline(place, Routes::kTargetDepth);
    auto spread = spreads_.find(name);
    if (spread == spreads_.end())
        spread =
            spreads_
                .emplace(name, Spread(outline, geometry_, traveller.radius + kStandClearance, kCircle + 0.1f))
                .first;
    middle = middleOf(outline);
    if (traveller.member == 0) party_spots_[name] = spread->second.next().value_or(middle);
    const glm::vec2 spot = party_spots_[name];
    if (traveller.party_size < 2) return spot;
    middle = spot;
    const float angle = 2.0f * std::numbers::pi_v<float> *
                        (static_cast<float>(traveller.member) / static_cast<float>(traveller.party_size) +
                         0.618034f * static_cast<float>(traveller.leader % 89));
    const glm::vec2 place_in_ring = spot + kCircle * glm::vec2(std::cos(angle), std::sin(angle));
    const bool fits = wallDepth(geometry_, place_in_ring, traveller.radius) <= 0.0f &&
                      insidePolygon(outline, place_in_ring);
    return fits ? place_in_ring : spot;
}

std::uint32_t Itineraries::lineFor(const std::vector<glm::dvec2>& points, double spacing) {
    std::string key = fmt::format("{}", spacing);
    for (const glm::dvec2 point : points)
        key += fmt::format(" {} {}", point.x, point.y);
    const auto [entry, is_new] = lines_.try_emplace(key, static_cast<std::uint32_t>(scene_.lines.size()));
    if (is_new) {
        gpu::WaitingLine line{};
        line.first_point = static_cast<std::uint32_t>(scene_.line_points.size());
        line.point_count = static_cast<std::uint32_t>(points.size());
        line.spacing = static_cast<float>(spacing);
        line.candidate = gpu::NO_INDEX;
        scene_.lines.push_back(line);
        for (const glm::vec2 point : rebase_.local(points))
            scene_.line_points.push_back(point);
    }
    return entry->second;
}

}  // namespace throng::authoring
