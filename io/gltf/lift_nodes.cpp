// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/lift_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "io/gltf/meshes.h"

namespace throng::io {
namespace {

constexpr double kInside = 0.07;  // m: a cabin is less wide than its shaft, whose walls have a thickness
constexpr double kSlab = 0.1, kPanel = 0.03, kLeaf = 0.04;      // m, thick
constexpr double kFloor = 0.012, kCeiling = 2.25, kDoor = 2.1;  // m over its floor
constexpr double kSlides = 0.46;                                // of the doors' width
constexpr double kLevel = 0.01;                                 // m: a cabin that is so near is at a stop

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

Mesh box(glm::dvec2 low, glm::dvec2 high, double from, double to) {
    const std::array<glm::dvec2, 4> outline{{low, {high.x, low.y}, high, {low.x, high.y}}};
    return raisedMesh(closedWallMesh(outline, to - from), from);
}

/// Its own x points out of its doors.
Mesh cabinMesh(const LiftIdentity& lift) {
    const glm::dvec2 half(0.5 * lift.size.y - kInside, 0.5 * lift.size.x - kInside);
    Mesh mesh = box(-half, half, kFloor - kSlab, kFloor);
    append(mesh, box(-half, half, kCeiling, kCeiling + kSlab));
    append(mesh, box(-half, {half.x, kPanel - half.y}, kFloor, kCeiling));
    append(mesh, box({-half.x, half.y - kPanel}, half, kFloor, kCeiling));
    const auto isSame = [&](const LiftIdentity::Stop& stop) { return stop.doors == lift.doors; };
    if (std::ranges::all_of(lift.stops, isSame))
        append(mesh, box(-half, {kPanel - half.x, half.y}, kFloor, kCeiling));
    return turnedMesh(std::move(mesh), radians(lift.doors));
}

}  // namespace

float LiftNodes::of(std::uint32_t frame, std::size_t lift, LiftColumn column) const {
    return tracks_
        .track[(frame * tracks_.lifts.size() + lift) * kLiftFloats + static_cast<std::size_t>(column)];
}

/// Doors of a stop open while the cabin is there.
double LiftNodes::openAt(std::uint32_t frame, const Leaf& leaf) const {
    const double height = tracks_.lifts[leaf.lift].stops[leaf.stop].height;
    const bool is_here = of(frame, leaf.lift, LiftColumn::stop) == static_cast<float>(leaf.stop) &&
                         std::abs(of(frame, leaf.lift, LiftColumn::height) - height) < kLevel;
    return is_here ? of(frame, leaf.lift, LiftColumn::open) : 0.0;
}

void LiftNodes::addMeshes(GlbDocument& document) {
    if (empty()) return;
    const int steel = document.addMaterial("lift", colourFromHex(0x999b9e), 0.4);
    const int grey = document.addMaterial("lift door", colourFromHex(0xaeb0b2), 0.3);
    for (std::size_t number = 0; number < tracks_.lifts.size(); ++number) {
        const LiftIdentity& lift = tracks_.lifts[number];
        cabins_.push_back(document.addMesh("cabin", document.addGeometry(cabinMesh(lift)), steel));
        for (std::size_t stop = 0; stop < lift.stops.size(); ++stop) {
            const double angle = radians(lift.stops[stop].doors);
            const glm::dvec2 ahead(std::cos(angle), std::sin(angle)), aside(-ahead.y, ahead.x);
            const glm::dvec2 half(0.5 * kLeaf, 0.25 * lift.door_width);
            const Mesh mesh = turnedMesh(box(-half, half, kFloor, kDoor), angle);
            const int leaf = document.addMesh("lift door", document.addGeometry(mesh), grey);
            for (const double side : {-1.0, 1.0})
                leaves_.push_back(
                    {number, stop,
                     lift.at + 0.5 * lift.size.y * ahead + 0.25 * side * lift.door_width * aside,
                     kSlides * side * lift.door_width * aside, leaf});
        }
    }
}

void LiftNodes::addNodes(GlbDocument& document, int times) {
    if (empty()) return;
    const int all = document.addEmptyNode("lifts");
    for (std::size_t number = 0; number < tracks_.lifts.size(); ++number) {
        const LiftIdentity& lift = tracks_.lifts[number];
        const double height{of(0, number, LiftColumn::height)};
        const int cabin =
            document.addPlacedNode(all, "lift " + lift.id, cabins_[number], {lift.at.x, height, -lift.at.y});
        document.addSliding(cabin, times, frames_);
    }
    for (const Leaf& leaf : leaves_) {
        const double height = tracks_.lifts[leaf.lift].stops[leaf.stop].height;
        const int door =
            document.addPlacedNode(all, "lift door", leaf.mesh, {leaf.place.x, height, -leaf.place.y});
        document.addSliding(door, times, frames_);
    }
}

void LiftNodes::writeTracks(OutputFile& file) const {
    if (empty()) return;
    const auto write = [&](const auto& placeAt) {
        std::vector<float> track;
        for (std::uint32_t frame = 0; frame < frames_; ++frame) {
            const glm::dvec3 place = placeAt(frame);
            track.insert(track.end(), {static_cast<float>(place.x), static_cast<float>(place.z),
                                       static_cast<float>(-place.y)});
        }
        file.write(std::as_bytes(std::span(track)));
    };
    for (std::size_t number = 0; number < tracks_.lifts.size(); ++number)
        write([&](std::uint32_t frame) {
            return glm::dvec3(tracks_.lifts[number].at, of(frame, number, LiftColumn::height));
        });
    for (const Leaf& leaf : leaves_)
        write([&](std::uint32_t frame) {
            return glm::dvec3(leaf.place + openAt(frame, leaf) * leaf.slides,
                              tracks_.lifts[leaf.lift].stops[leaf.stop].height);
        });
}

}  // namespace throng::io
