// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/boarding.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "authoring/scene/lane_line.h"
#include "authoring/scene/traffic.h"
#include "base/polygon.h"

namespace throng::authoring {
namespace {

constexpr double kReach = 0.4;    // m: as far as people step from a vehicle's side on to a platform
constexpr double kBeside = 0.02;  // m: a platform may begin right beside the vehicle

const LaneStop& stopOf(const Layout& layout, std::size_t lane, std::size_t stop) {
    return layout.traffic.lanes[lane].stops[stop];
}

bool opensOn(const VehicleDoors& doors, double side) {
    const auto needed = side > 0.0 ? VehicleDoors::Sides::left : VehicleDoors::Sides::right;
    return (static_cast<int>(doors.sides) & static_cast<int>(needed)) != 0;
}

/// Which of the lines one is.
std::uint32_t lineNumber(const Layout& layout, std::size_t flow) {
    const auto& vehicles = layout.traffic.vehicles;
    return static_cast<std::uint32_t>(
        std::count_if(vehicles.begin(), vehicles.begin() + static_cast<std::ptrdiff_t>(flow),
                      [](const VehicleFlow& each) { return each.doors.has_value(); }));
}

/// m: the side of a platform's middle, seen along its lane; above 0 on the left.
double sideOf(const Layout& layout, std::size_t lane, const LaneStop& stop) {
    const Lane& of = layout.traffic.lanes[lane];
    const LaneLine line(of.points);
    glm::dvec2 middle(0.0);
    const std::vector<glm::dvec2>& area = layout.areas[stop.platform->area].polygon;
    for (const glm::dvec2 point : area)
        middle += point / static_cast<double>(area.size());
    const double along = line.alongAt(stop.at);
    const glm::dvec2 way = line.wayAt(along), offset = middle - line.placeAt(along);
    return way.x * offset.y - way.y * offset.x;
}

/// Looks at what platforms there are, and at who serves them.
class Checker {
  public:
    Checker(const Layout& layout, Diagnostics& diagnostics) : layout_(layout), diagnostics_(diagnostics) {}

    void check() {
        const std::vector<Lane>& lanes = layout_.traffic.lanes;
        for (std::size_t lane = 0; lane < lanes.size(); ++lane)
            for (std::size_t stop = 0; stop < lanes[lane].stops.size(); ++stop)
                if (lanes[lane].stops[stop].platform) checkStop(lane, stop);
        for (std::size_t i = 0; i < layout_.traffic.vehicles.size(); ++i)
            if (layout_.traffic.vehicles[i].doors) checkLine(i);
        for (const Flow& flow : layout_.flows)
            for (const auto& at : {flow.alights, flow.boards})
                if (at) checkServed(flow, *at);
    }

  private:
    void checkStop(std::size_t lane, std::size_t number) {
        const LaneStop& stop = stopOf(layout_, lane, number);
        bool served = false;
        for (const VehicleFlow& flow : layout_.traffic.vehicles) {
            if (flow.lane != lane || !flow.doors) continue;
            served = true;
            checkDoors(flow, lane, stop);
            constexpr double kLetsThrough = 2.0;  // s: for one person
            const double needed = 2.0 * flow.doors->time + double{gpu::CLEARING} + kLetsThrough;
            if (stop.platform->most < needed)
                diagnostics_.error(
                    stop.where,
                    fmt::format("vehicles stand at `{}` for {:.6g} s at most: doors of `{}` take {:.6g} s to "
                                "open and as long to close",
                                stop.platform->id, stop.platform->most, flow.id, flow.doors->time),
                    fmt::format("let the second number of `dwell` be {:.6g} or more", needed));
        }
        if (!served)
            diagnostics_.warning(stop.where,
                                 fmt::format("no vehicle with doors stops at `{}`", stop.platform->id),
                                 R"(let "kind": "bus" or "tram" come on its lane, or give others `doors`)");
    }

    void checkDoors(const VehicleFlow& flow, std::size_t lane, const LaneStop& stop) {
        const double side = sideOf(layout_, lane, stop) > 0.0 ? 1.0 : -1.0;
        const char* name = side > 0.0 ? "left" : "right";
        const Area& area = layout_.areas[stop.platform->area];
        if (!opensOn(*flow.doors, side)) {
            diagnostics_.error(flow.where,
                               fmt::format("`{}` has no doors on the {}, where the platform `{}` of `{}` is",
                                           flow.id, name, area.id, stop.platform->id),
                               fmt::format(R"(write "doors": {{"sides": "{}"}}, or "both")", name));
            return;
        }
        const LaneLine line(layout_.traffic.lanes[lane].points);
        const double front = line.alongAt(stop.at), half = 0.5 * typeOf(flow.kind).width;
        for (const double behind : flow.doors->at) {
            const double along = front - behind;
            const glm::dvec2 way = line.wayAt(along), out = side * glm::dvec2(-way.y, way.x);
            const glm::dvec2 at = line.placeAt(along);
            const bool is_there = isWithin(area.polygon, at + out * (half + kReach));
            const bool is_in_it = isWithin(area.polygon, at + out * (half - kBeside));
            if (is_there && !is_in_it) continue;
            diagnostics_.error(
                stop.where,
                is_in_it
                    ? fmt::format("the platform `{}` reaches into `{}`, which is {:.6g} m wide", area.id,
                                  flow.id, 2.0 * half)
                    : fmt::format("the door of `{}` {:.6g} m behind its front opens at [{:.6g}, {:.6g}], "
                                  "where there is no ground of `{}`",
                                  flow.id, behind, (at + out * half).x, (at + out * half).y, area.id),
                fmt::format("a platform begins at the vehicle's side, or up to {:.2g} m beside it, and is "
                            "there before all doors",
                            kReach));
            return;
        }
    }

    void checkLine(std::size_t number) {
        const VehicleFlow& flow = layout_.traffic.vehicles[number];
        const auto names = [&](const std::optional<AtPlatform>& at) {
            return at && std::ranges::find(at->lines, number) != at->lines.end();
        };
        std::uint64_t leaving = 0;
        bool used = false;
        for (const Flow& people : layout_.flows) {
            used = used || names(people.alights) || names(people.boards);
            if (names(people.alights)) leaving += people.count.value_or(0);
        }
        if (leaving > flow.aboard.value_or(flow.capacity))
            diagnostics_.error(flow.where,
                               flow.aboard ? fmt::format("{} people get off each `{}`, and {} are aboard",
                                                         leaving, flow.id, *flow.aboard)
                                           : fmt::format("{} people get off each `{}`, which holds {}",
                                                         leaving, flow.id, flow.capacity),
                               "lower `count` of the flows that `alight`, or raise what it holds");
        const bool stops =
            std::ranges::any_of(layout_.traffic.lanes[flow.lane].stops,
                                [](const LaneStop& stop) { return stop.platform.has_value(); });
        if (stops && !used)
            diagnostics_.warning(flow.where, fmt::format("nobody gets on or off `{}`", flow.id),
                                 "it stops at a platform: let flows `board` or `alight` there");
    }

    void checkServed(const Flow& flow, const AtPlatform& at) {
        const StopPlatform& platform = *stopOf(layout_, at.lane, at.stop).platform;
        std::size_t vehicles = 0;
        for (const std::size_t line : at.lines)
            vehicles += vehicleTimes(layout_, layout_.traffic.vehicles[line]).size();
        if (vehicles > 0) return;
        diagnostics_.error(at.where,
                           fmt::format("flow `{}`: no vehicle with doors comes to `{}`, so nobody could get "
                                       "{} there",
                                       flow.id, platform.id, flow.boards ? "on" : "off"),
                           fmt::format("let vehicles come on lane `{}`", layout_.traffic.lanes[at.lane].id));
    }

    const Layout& layout_;
    Diagnostics& diagnostics_;
};

std::uint32_t leavingEach(const Layout& layout, std::size_t line) {
    std::uint64_t people = 0;
    for (const Flow& flow : layout.flows)
        if (flow.alights && std::ranges::find(flow.alights->lines, line) != flow.alights->lines.end())
            people += flow.count.value_or(0);
    return static_cast<std::uint32_t>(people);
}

gpu::VehicleService serviceOf(const Layout& layout, std::size_t line, SceneTraffic& traffic) {
    const VehicleFlow& flow = layout.traffic.vehicles[line];
    gpu::VehicleService service{};
    service.platform = gpu::NO_INDEX;
    service.first_door = static_cast<std::uint32_t>(traffic.doors.size());
    service.first_call = static_cast<std::uint32_t>(traffic.calls.size());
    if (!flow.doors) return service;
    for (const double behind : flow.doors->at)
        traffic.doors.push_back({static_cast<float>(behind), static_cast<float>(0.5 * flow.doors->width),
                                 static_cast<gpu::uint>(flow.doors->sides), 0});
    service.door_count = static_cast<std::uint32_t>(flow.doors->at.size());
    service.line = 1u << (gpu::BOARD_LINES_AT + lineNumber(layout, line));
    service.capacity = flow.capacity;
    service.door_time = static_cast<float>(flow.doors->time);
    service.door_flow = static_cast<float>(flow.doors->flow);
    service.aboard = flow.aboard.value_or(leavingEach(layout, line));
    return service;
}

bool isOfSensibleNumber(const Layout& layout, Diagnostics& diagnostics) {
    std::size_t platforms = 0, lines = 0;
    for (const Lane& lane : layout.traffic.lanes)
        for (const LaneStop& stop : lane.stops)
            if (stop.platform && ++platforms > gpu::MOST_PLATFORMS)
                diagnostics.error(stop.where, fmt::format("a bake holds {} platforms", gpu::MOST_PLATFORMS));
    for (const VehicleFlow& flow : layout.traffic.vehicles)
        if (flow.doors && ++lines > gpu::MOST_LINES && platforms > 0)
            diagnostics.error(flow.where,
                              fmt::format("a bake holds {} flows of vehicles with doors", gpu::MOST_LINES),
                              "let one of them come at more `times`");
    return platforms > 0 && !diagnostics.hasErrors();
}

}  // namespace

std::uint64_t alightingPeople(const Layout& layout, const Flow& flow) {
    std::uint64_t vehicles = 0;
    for (const std::size_t line : flow.alights->lines)
        vehicles += vehicleTimes(layout, layout.traffic.vehicles[line]).size();
    return vehicles * flow.count.value_or(0);
}

std::uint32_t platformNumber(const Layout& layout, std::size_t lane, std::size_t stop) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i <= lane; ++i) {
        const std::vector<LaneStop>& stops = layout.traffic.lanes[i].stops;
        const std::size_t end = i < lane ? stops.size() : stop;
        for (std::size_t j = 0; j < end; ++j)
            number += stops[j].platform ? 1 : 0;
    }
    return number;
}

std::uint32_t boardWord(const Layout& layout, const AtPlatform& at) {
    std::uint32_t word = 1 + platformNumber(layout, at.lane, at.stop);
    for (const std::size_t line : at.lines)
        word |= 1u << (gpu::BOARD_LINES_AT + lineNumber(layout, line));
    return word;
}

glm::dvec2 sightAt(const Layout& layout, const AtPlatform& at) {
    double length = 0.0;
    for (const std::size_t line : at.lines)
        length = std::max(length, typeOf(layout.traffic.vehicles[line].kind).length);
    const LaneLine line(layout.traffic.lanes[at.lane].points);
    return line.placeAt(line.alongAt(stopOf(layout, at.lane, at.stop).at) - 0.5 * length);
}

void addBoarding(const Layout& layout, const Rebase& rebase, SceneTraffic& traffic,
                 Diagnostics& diagnostics) {
    if (!isOfSensibleNumber(layout, diagnostics)) return;
    Checker(layout, diagnostics).check();
    for (std::size_t lane = 0; lane < layout.traffic.lanes.size(); ++lane)
        for (const LaneStop& stop : layout.traffic.lanes[lane].stops) {
            if (!stop.platform) continue;
            gpu::Platform made{};
            made.side = sideOf(layout, lane, stop) > 0.0 ? 1.0f : -1.0f;
            made.least = static_cast<float>(stop.platform->least);
            made.most = static_cast<float>(stop.platform->most);
            made.first_point = static_cast<std::uint32_t>(traffic.platform_points.size());
            const std::vector<glm::dvec2>& area = layout.areas[stop.platform->area].polygon;
            made.point_count = static_cast<std::uint32_t>(area.size());
            for (const glm::dvec2 point : area)
                traffic.platform_points.push_back(rebase.local(point));
            traffic.platforms.push_back(made);
        }
    for (const std::uint32_t line : traffic.flow_of)
        traffic.services.push_back(serviceOf(layout, line, traffic));
}

void addCalls(const Layout& layout, const std::vector<gpu::SpawnQueue>& queues, SceneTraffic& traffic) {
    std::vector<std::uint32_t> taken(layout.flows.size(), 0);
    for (std::size_t vehicle = 0; vehicle < traffic.services.size(); ++vehicle) {
        gpu::VehicleService& service = traffic.services[vehicle];
        service.first_call = static_cast<std::uint32_t>(traffic.calls.size());
        for (std::size_t i = 0; i < layout.flows.size(); ++i) {
            const std::optional<AtPlatform>& at = layout.flows[i].alights;
            if (!at || std::ranges::find(at->lines, traffic.flow_of[vehicle]) == at->lines.end()) continue;
            const auto count = static_cast<std::uint32_t>(layout.flows[i].count.value_or(0));
            traffic.calls.push_back(
                {platformNumber(layout, at->lane, at->stop), queues[i].first_row + taken[i], count});
            taken[i] += count;
        }
        service.call_count = static_cast<std::uint32_t>(traffic.calls.size()) - service.first_call;
    }
}

}  // namespace throng::authoring
