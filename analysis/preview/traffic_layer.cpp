// SPDX-License-Identifier: Apache-2.0
#include "analysis/preview/traffic_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "analysis/preview/colour.h"
#include "base/door_track.h"
#include "base/palette.h"
#include "base/vehicle_track.h"
#include "io/door_file.h"
#include "io/vehicle_file.h"

namespace throng::analysis {
namespace {

constexpr Colour kAsphalt = colourFromHex(0xcfcdc8), kPaint = colourFromHex(0xfbfaf7),
                 kGreen = colourFromHex(0x2f8f4e), kRed = colourFromHex(0xc0392b),
                 kGlass = colourFromHex(0xdfe8ee);
constexpr double kStripe = 0.5;  // m

Colour colourOf(const std::string& kind) {
    if (kind == "bus") return colourFromHex(0x8a5a2b);
    if (kind == "tram") return colourFromHex(0x7d2f3a);
    if (kind == "bicycle") return colourFromHex(0x3f6f6b);
    return colourFromHex(0x4b5563);
}

void addPath(cairo_t* context, const PlateView& view, std::span<const glm::dvec2> points) {
    cairo_new_path(context);
    for (const glm::dvec2 point : points) {
        const glm::dvec2 at = view.toPixel(point);
        cairo_line_to(context, at.x, at.y);
    }
}

/// The drawing's own part of the picture: lanes begin outside.
void clipTo(cairo_t* context, const PlateView& view) {
    const glm::dvec2 size = (view.maximum - view.minimum) * view.scale;
    cairo_new_path(context);
    cairo_rectangle(context, view.left, view.top, size.x, size.y);
    cairo_clip(context);
}

void drawLight(cairo_t* context, const PlateView& view, glm::dvec2 place, bool green) {
    const glm::dvec2 at = view.toPixel(place);
    cairo_new_path(context);
    cairo_arc(context, at.x, at.y, std::max(3.0, 0.3 * view.scale), 0.0, 6.2831853);
    setColour(context, green ? kGreen : kRed);
    cairo_fill(context);
}

bool has(const std::vector<std::size_t>& indices, std::size_t index) {
    return std::ranges::find(indices, index) != indices.end();
}

}  // namespace

TrafficLayer::TrafficLayer(const io::Bake& bake) : bake_(bake) {
    if (!bake.vehicles.empty()) track_ = io::readVehicles(bake);
    if (!bake.doors.empty()) doors_ = io::readDoors(bake);
}

void TrafficLayer::drawStreet(cairo_t* context, const PlateView& view) const {
    cairo_save(context);
    clipTo(context, view);
    for (const authoring::Lane& lane : bake_.traffic.lanes) {
        addPath(context, view, lane.points);
        cairo_set_line_width(context, lane.width * view.scale);
        cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
        setColour(context, kAsphalt);
        cairo_stroke(context);
    }
    for (const authoring::Zebra& crossing : bake_.traffic.crossings)
        drawCrossing(context, view, crossing);
    cairo_restore(context);
}

/// Stripes lie along the first lane that comes near; across the crossing's longer side where none does.
void TrafficLayer::drawCrossing(cairo_t* context, const PlateView& view,
                                const authoring::Zebra& crossing) const {
    glm::dvec2 lower = crossing.polygon.front(), upper = lower, along(1.0, 0.0);
    double least = 1.0e300;
    glm::dvec2 middle(0.0);
    for (const glm::dvec2 point : crossing.polygon)
        middle += point / static_cast<double>(crossing.polygon.size());
    for (const authoring::Lane& lane : bake_.traffic.lanes)
        for (std::size_t i = 1; i < lane.points.size(); ++i) {
            const glm::dvec2 way = glm::normalize(lane.points[i] - lane.points[i - 1]);
            const glm::dvec2 offset = middle - lane.points[i - 1];
            const double ahead = glm::dot(offset, way);
            const double apart = std::abs(way.x * offset.y - way.y * offset.x);
            if (ahead < 0.0 || ahead > glm::distance(lane.points[i], lane.points[i - 1]) || apart > least)
                continue;
            least = apart;
            along = way;
        }
    const glm::dvec2 aside(-along.y, along.x);
    lower = upper = glm::dvec2(0.0);
    for (const glm::dvec2 point : crossing.polygon) {
        const glm::dvec2 local(glm::dot(point - middle, along), glm::dot(point - middle, aside));
        lower = {std::min(lower.x, local.x), std::min(lower.y, local.y)};
        upper = {std::max(upper.x, local.x), std::max(upper.y, local.y)};
    }
    cairo_save(context);
    addPath(context, view, crossing.polygon);
    cairo_clip(context);
    setColour(context, kPaint);
    const int stripes = static_cast<int>(std::ceil((upper.y - lower.y) / (2.0 * kStripe)));
    for (int i = 0; i < stripes; ++i) {
        const double at = lower.y + (2.0 * i + 0.5) * kStripe;
        const auto corner = [&](double x, double y) { return middle + along * x + aside * y; };
        addPath(context, view,
                std::array{corner(lower.x, at), corner(upper.x, at), corner(upper.x, at + kStripe),
                           corner(lower.x, at + kStripe)});
        cairo_fill(context);
    }
    cairo_restore(context);
}

void TrafficLayer::drawLights(cairo_t* context, const PlateView& view, double time) const {
    const authoring::Traffic& traffic = bake_.traffic;
    for (std::size_t i = 0; i < traffic.lanes.size(); ++i)
        for (const authoring::LaneStop& stop : traffic.lanes[i].stops) {
            if (!stop.signal) continue;
            const authoring::Signal& signal = traffic.signals[*stop.signal];
            drawLight(context, view, stop.at, has(signal.phases[signal.phaseAt(time)].lanes, i));
        }
    for (const authoring::Signal& signal : traffic.signals)
        for (std::size_t i = 0; i < traffic.crossings.size(); ++i) {
            if (std::ranges::none_of(signal.phases,
                                     [&](const authoring::Phase& phase) { return has(phase.crossings, i); }))
                continue;
            const bool green = has(signal.phases[signal.phaseAt(time)].crossings, i);
            addPath(context, view, traffic.crossings[i].polygon);
            cairo_close_path(context);
            setColour(context, green ? kGreen : kRed);
            cairo_set_line_width(context, 2.0);
            cairo_stroke(context);
        }
}

template <class Corner>
void TrafficLayer::drawDoors(cairo_t* context, const PlateView& view, std::uint32_t frame,
                             std::size_t vehicle, Corner corner) const {
    if (doors_.empty()) return;
    constexpr double kDeep = 0.35;  // m
    const DoorIdentity& doors = bake_.doors[vehicle];
    const VehicleIdentity& what = bake_.vehicles[vehicle];
    for (const double side : {1.0, -1.0}) {
        const auto column = side > 0.0 ? DoorColumn::left : DoorColumn::right;
        const std::size_t row = frame * bake_.vehicles.size() + vehicle;
        const double half = 0.5 * doors.width * double{doorIn(doors_, row, column)};
        if (half <= 0.0) continue;
        const double inner = side * (1.0 - 2.0 * kDeep / what.width);
        for (const double at : doors.at) {
            const double begin = 1.0 - 2.0 * (at + half) / what.length;
            const double end = 1.0 - 2.0 * (at - half) / what.length;
            addPath(
                context, view,
                std::array{corner(begin, side), corner(end, side), corner(end, inner), corner(begin, inner)});
            setColour(context, kPaint);
            cairo_fill(context);
        }
    }
}

void TrafficLayer::drawVehicle(cairo_t* context, const PlateView& view, std::uint32_t frame,
                               std::size_t vehicle) const {
    const std::span<const float> at =
        std::span(track_).subspan((frame * bake_.vehicles.size() + vehicle) * kVehicleFloats, kVehicleFloats);
    if (at[static_cast<std::size_t>(VehicleColumn::state)] == kVehicleAway) return;
    const VehicleIdentity& what = bake_.vehicles[vehicle];
    const double heading = at[static_cast<std::size_t>(VehicleColumn::heading)];
    const glm::dvec2 along(std::cos(heading), std::sin(heading)), aside(-along.y, along.x);
    const auto corner = [&](double x, double y) {
        return glm::dvec2(at[0], at[1]) + along * (0.5 * x * what.length) + aside * (0.5 * y * what.width);
    };
    addPath(context, view,
            std::array{corner(-1.0, -1.0), corner(0.9, -1.0), corner(1.0, -0.6), corner(1.0, 0.6),
                       corner(0.9, 1.0), corner(-1.0, 1.0)});
    setColour(context, colourOf(what.kind));
    cairo_fill(context);
    if (what.kind == "bicycle") return;
    drawDoors(context, view, frame, vehicle, corner);
    const double glass = 1.0 - 2.0 * 1.6 / what.length;  // the windscreen tells where the front is
    addPath(context, view,
            std::array{corner(glass, -0.8), corner(glass + 0.8 / what.length, -0.75),
                       corner(glass + 0.8 / what.length, 0.75), corner(glass, 0.8)});
    setColour(context, kGlass);
    cairo_fill(context);
}

void TrafficLayer::drawFrame(cairo_t* context, const PlateView& view, std::uint32_t frame) const {
    cairo_save(context);
    clipTo(context, view);
    drawLights(context, view, frame / bake_.fps);
    for (std::size_t i = 0; i < bake_.vehicles.size(); ++i)
        drawVehicle(context, view, frame, i);
    cairo_restore(context);
}

}  // namespace throng::analysis
