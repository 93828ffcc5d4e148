// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/traffic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "authoring/scene/boarding.h"
#include "authoring/scene/lane_line.h"
#include "authoring/scene/random.h"
#include "base/polygon.h"

namespace throng::authoring {
namespace {

constexpr double kBeforeCrossing = 1.0;  // m: between fronts that stand and people who walk

double crossOf(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

/// How far along a line it comes to a polygon, if it does.
std::optional<double> entryInto(const std::vector<glm::dvec2>& points,
                                const std::vector<glm::dvec2>& polygon) {
    std::optional<double> first;
    double before = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec2 axis = points[i] - points[i - 1];
        for (std::size_t j = 0; j < polygon.size(); ++j) {
            const glm::dvec2 a = polygon[j], edge = polygon[(j + 1) % polygon.size()] - a;
            const double across = crossOf(axis, edge);
            if (across == 0.0) continue;
            const double on_line = crossOf(a - points[i - 1], edge) / across;
            const double on_edge = crossOf(a - points[i - 1], axis) / across;
            if (on_line < 0.0 || on_line > 1.0 || on_edge < 0.0 || on_edge > 1.0) continue;
            const double along = before + on_line * glm::length(axis);
            first = std::min(first.value_or(along), along);
        }
        before += glm::length(axis);
    }
    return first;
}

class Builder {
  public:
    Builder(const Layout& layout, const Rebase& rebase, Diagnostics& diagnostics)
        : layout_(layout), traffic_(layout.traffic), rebase_(rebase), diagnostics_(diagnostics) {}

    SceneTraffic build() {
        for (std::size_t i = 0; i < traffic_.crossings.size(); ++i)
            addCrossing(i);
        for (std::size_t i = 0; i < traffic_.lanes.size(); ++i)
            addLane(i);
        for (std::size_t i = 0; i < traffic_.vehicles.size(); ++i)
            addVehicles(i);
        sortVehicles();
        addBoarding(layout_, rebase_, scene_, diagnostics_);
        return std::move(scene_);
    }

  private:
    void addCrossing(std::size_t index) {
        const Zebra& crossing = traffic_.crossings[index];
        gpu::TrafficCrossing made{};
        made.first_point = static_cast<std::uint32_t>(scene_.crossing_points.size());
        made.point_count = static_cast<std::uint32_t>(crossing.polygon.size());
        made.light = gpu::NO_LIGHT;
        for (const Signal& signal : traffic_.signals)
            if (made.light == gpu::NO_LIGHT) made.light = lightOf(signal, {false, index});
        made.entries = entriesOf(crossing);
        for (const glm::dvec2 point : crossing.polygon)
            scene_.crossing_points.push_back(rebase_.local(point));
        scene_.crossings.push_back(made);
    }

    /// Its edges with walkable ground behind them, as bits; all where there is nothing to tell them by.
    std::uint32_t entriesOf(const Zebra& crossing) const {
        constexpr double kBeyond = 0.5;  // m
        std::uint32_t found = 0;
        const std::size_t count = std::min<std::size_t>(crossing.polygon.size(), gpu::MOST_ENTRIES);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec2 a = crossing.polygon[i];
            const glm::dvec2 edge = crossing.polygon[(i + 1) % crossing.polygon.size()] - a;
            const glm::dvec2 outward = glm::normalize(glm::dvec2(edge.y, -edge.x)) * kBeyond;
            for (const glm::dvec2 beyond : {a + 0.5 * edge + outward, a + 0.5 * edge - outward})
                if (!isWithin(crossing.polygon, beyond) && isWalkable(beyond)) found |= 1u << i;
        }
        return found ? found : ~0u;
    }

    bool isWalkable(glm::dvec2 place) const {
        return std::ranges::any_of(layout_.areas,
                                   [&](const Area& area) { return isWithin(area.polygon, place); }) ||
               std::ranges::any_of(layout_.roads, [&](const Road& road) {
                   return distanceToPieces(road.centreline, road.centreline.size() - 1, place) <=
                          0.5 * road.width;
               });
    }

    /// When something is green by a signal; gpu::NO_LIGHT where the signal does not have it.
    std::uint32_t lightOf(const Signal& signal, const Lit& what) {
        std::optional<LightPlan> plan = lightPlan(signal, what);
        if (!plan) return gpu::NO_LIGHT;
        scene_.lights.push_back(std::move(*plan));
        return static_cast<std::uint32_t>(scene_.lights.size() - 1);
    }

    void addLane(std::size_t index) {
        const Lane& lane = traffic_.lanes[index];
        gpu::TrafficLane made{};
        made.first_point = static_cast<std::uint32_t>(scene_.lane_points.size());
        made.point_count = static_cast<std::uint32_t>(lane.points.size());
        made.first_stop = static_cast<std::uint32_t>(scene_.stops.size());
        double along = 0.0;
        for (std::size_t i = 0; i < lane.points.size(); ++i) {
            if (i > 0) along += glm::distance(lane.points[i], lane.points[i - 1]);
            scene_.lane_points.push_back({rebase_.local(lane.points[i]), static_cast<float>(along), 0});
        }
        made.length = static_cast<float>(along);
        for (const LaneStop& stop : lane.stops)
            addStop(lane, stop, index);
        for (std::size_t crossing = 0; crossing < traffic_.crossings.size(); ++crossing)
            addCrossingStop(lane, crossing);
        std::stable_sort(
            scene_.stops.begin() + made.first_stop, scene_.stops.end(),
            [](const gpu::TrafficStop& a, const gpu::TrafficStop& b) { return a.along < b.along; });
        made.stop_count = static_cast<std::uint32_t>(scene_.stops.size()) - made.first_stop;
        scene_.lanes.push_back(made);
    }

    void addStop(const Lane& lane, const LaneStop& stop, std::size_t index) {
        gpu::TrafficStop made{};
        made.along = static_cast<float>(LaneLine(lane.points).alongAt(stop.at));
        made.seconds = static_cast<float>(stop.seconds);
        made.kind = stop.signal ? gpu::STOP_AT_RED : gpu::STOP_FOR_TIME;
        made.light = stop.signal ? lightOf(traffic_.signals[*stop.signal], {true, index}) : gpu::NO_LIGHT;
        made.crossing = gpu::NO_INDEX;
        if (stop.platform) {
            made.kind = gpu::STOP_AT_PLATFORM;
            made.crossing =
                platformNumber(layout_, index, static_cast<std::size_t>(&stop - lane.stops.data()));
        }
        scene_.stops.push_back(made);
    }

    void addCrossingStop(const Lane& lane, std::size_t crossing) {
        const auto entry = entryInto(lane.points, traffic_.crossings[crossing].polygon);
        if (!entry) return;
        gpu::TrafficStop made{};
        made.along = static_cast<float>(*entry - kBeforeCrossing);
        made.kind = gpu::STOP_FOR_PEOPLE;
        made.light = scene_.crossings[crossing].light;
        made.crossing = static_cast<std::uint32_t>(crossing);
        scene_.stops.push_back(made);
    }

    void addVehicles(std::size_t index) {
        const VehicleFlow& flow = traffic_.vehicles[index];
        scene_.flows.push_back(flow.id);
        for (const double time : vehicleTimes(layout_, flow)) {
            const Lane& lane = traffic_.lanes[flow.lane];
            const VehicleType& type = typeOf(flow.kind);
            gpu::Vehicle vehicle{};
            vehicle.status = gpu::VEHICLE_TO_COME;
            vehicle.lane = static_cast<std::uint32_t>(flow.lane);
            vehicle.next_stop = scene_.lanes[flow.lane].first_stop;
            vehicle.kind = static_cast<std::uint32_t>(flow.kind);
            vehicle.start = static_cast<float>(time);
            vehicle.length = static_cast<float>(type.length);
            vehicle.half_width = static_cast<float>(0.5 * type.width);
            vehicle.wished_speed = static_cast<float>(std::min(type.speed, lane.speed));
            vehicle.headway = static_cast<float>(type.headway);
            vehicle.most_acceleration = static_cast<float>(type.acceleration);
            vehicle.braking = static_cast<float>(type.braking);
            vehicle.gap = static_cast<float>(type.gap);
            scene_.vehicles.push_back(vehicle);
            scene_.flow_of.push_back(static_cast<std::uint32_t>(index));
        }
        if (scene_.vehicles.size() <= gpu::MOST_VEHICLES) return;
        diagnostics_.error(flow.where,
                           fmt::format("with flow `{}` there are {} vehicles: a bake holds {}", flow.id,
                                       scene_.vehicles.size(), gpu::MOST_VEHICLES),
                           "lower its `rate`, or let it end sooner");
    }

    /// In the order of their times: who is to come first comes first in the list.
    void sortVehicles() {
        std::vector<std::size_t> order(scene_.vehicles.size());
        for (std::size_t i = 0; i < order.size(); ++i)
            order[i] = i;
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return scene_.vehicles[a].start < scene_.vehicles[b].start;
        });
        std::vector<gpu::Vehicle> vehicles;
        std::vector<std::uint32_t> flow_of;
        for (const std::size_t i : order) {
            vehicles.push_back(scene_.vehicles[i]);
            flow_of.push_back(scene_.flow_of[i]);
        }
        scene_.vehicles = std::move(vehicles);
        scene_.flow_of = std::move(flow_of);
    }

    const Layout& layout_;
    const Traffic& traffic_;
    const Rebase& rebase_;
    Diagnostics& diagnostics_;
    SceneTraffic scene_;
};

}  // namespace

bool keepsOffStreets(const Layout& layout) {
    const Traffic& traffic = layout.traffic;
    const auto has_platform = [](const Lane& lane) {
        return std::ranges::any_of(lane.stops,
                                   [](const LaneStop& stop) { return stop.platform.has_value(); });
    };
    return !traffic.crossings.empty() || std::ranges::any_of(traffic.lanes, has_platform);
}

bool keepsToRoads(const Layout& layout) {
    return !layout.roads.empty() || keepsOffStreets(layout);
}

bool isWithoutTraffic(const Layout& layout, Diagnostics& diagnostics) {
    const Traffic& traffic = layout.traffic;
    if (traffic.empty()) return true;
    diagnostics.error(
        traffic.lanes.empty() ? traffic.crossings.front().where : traffic.lanes.front().where,
        "layouts with `levels` have lanes and crossings only on a `terrain`",
        "make the street a layout of its own, or the whole a terrain of which `levels` name grounds");
    return false;
}

std::vector<double> vehicleTimes(const Layout& layout, const VehicleFlow& flow) {
    if (!flow.rate) return flow.times;
    constexpr std::uint64_t kEnough = gpu::MOST_VEHICLES + 1;
    const GroupRandom random(layout.simulation.seed, "vehicles " + flow.id);
    std::vector<double> times;
    double time = flow.start == 0.0 ? -layout.simulation.warmup : flow.start;
    for (std::uint64_t i = 0; i < kEnough; ++i) {
        time -= std::log(1.0 - random.unit(i, Purpose::time)) / *flow.rate;
        if (time >= flow.end) break;
        times.push_back(time);
    }
    return times;
}

std::optional<LightPlan> lightPlan(const Signal& signal, const Lit& what) {
    LightPlan plan;
    plan.offset = signal.offset;
    plan.cycle = 0.0;
    for (const Phase& phase : signal.phases) {
        if (phase.isGreen(what)) plan.green.push_back({plan.cycle, plan.cycle + phase.seconds});
        plan.cycle += phase.seconds;
    }
    return plan.green.empty() ? std::nullopt : std::optional(std::move(plan));
}

SceneTraffic buildTraffic(const Layout& layout, const Rebase& rebase, Diagnostics& diagnostics) {
    return Builder(layout, rebase, diagnostics).build();
}

}  // namespace throng::authoring
