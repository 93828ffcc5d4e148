// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/vehicle_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/palette.h"
#include "base/vehicle_track.h"
#include "io/gltf/meshes.h"

namespace throng::io {
namespace {

constexpr int kSides = 16;                                      // of a wheel
constexpr double kBicycleTyre = 0.04;                           // m
constexpr double kLeaf = 0.05, kDoorLow = 0.3, kDoorTop = 2.3;  // m: thick, and over the ground

/// A hull whose ends narrow.
Mesh hull(double length, double width, double low, double high) {
    const double x = 0.5 * length, y = 0.5 * width, cut = std::min(0.25 * width, 0.3);
    const std::array<glm::dvec2, 8> outline{{{-x, -y + cut},
                                             {-x + cut, -y},
                                             {x - cut, -y},
                                             {x, -y + cut},
                                             {x, y - cut},
                                             {x - cut, y},
                                             {-x + cut, y},
                                             {-x, y - cut}}};
    return raisedMesh(closedWallMesh(outline, high - low), low);
}

/// A wheel's disc, lying on its side before it is put up.
Mesh wheelAt(double radius, double from, double to) {
    std::vector<glm::dvec2> circle;
    for (int i = 0; i < kSides; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kSides;
        circle.push_back(radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    Mesh mesh = closedWallMesh(circle, to - from), other_side = polygonMesh(circle, 0.0);
    for (glm::vec3& position : other_side.positions)
        position.y = -position.y;
    for (glm::vec3& normal : other_side.normals)
        normal = -normal;
    append(mesh, other_side);
    const auto up = [](glm::vec3 v) { return glm::vec3(v.x, -v.z, v.y); };
    for (glm::vec3& position : mesh.positions)
        position = up(position) - glm::vec3(0.0f, static_cast<float>(from), 0.0f);
    for (glm::vec3& normal : mesh.normals)
        normal = up(normal);
    return mesh;
}

Mesh axleMesh(const VehicleIdentity& vehicle) {
    if (vehicle.kind == "bicycle") return wheelAt(vehicle.wheel, -0.5 * kBicycleTyre, 0.5 * kBicycleTyre);
    const double outer = 0.5 * vehicle.width - 0.02, inner = outer - 0.22;
    Mesh mesh = wheelAt(vehicle.wheel, inner, outer);
    append(mesh, wheelAt(vehicle.wheel, -outer, -inner));
    return mesh;
}

std::vector<double> axlesOf(const VehicleIdentity& vehicle) {
    const double x = 0.5 * vehicle.length;
    if (vehicle.kind == "tram") return {x - 2.9, x - 4.7, 0.9, -0.9, -x + 4.7, -x + 2.9};
    if (vehicle.kind == "bus") return {x - 2.65, -x + 3.15};
    if (vehicle.kind == "bicycle") return {x - vehicle.wheel, -x + vehicle.wheel};
    return {x - 0.85, -x + 0.85};
}

Colour colourOf(const std::string& kind) {
    if (kind == "bus") return colourFromHex(0xa03a2e);
    if (kind == "tram") return colourFromHex(0xc9bd97);
    if (kind == "bicycle") return colourFromHex(0x3f6f6b);
    return colourFromHex(0x5a6472);
}

/// The body; of a bicycle its frame and whoever rides it, as a plain shape.
Mesh bodyOf(const VehicleIdentity& vehicle) {
    if (vehicle.kind != "bicycle")
        return hull(vehicle.length, vehicle.width, 0.25, vehicle.kind == "car" ? 0.92 : vehicle.height);
    Mesh mesh = hull(1.1, 0.06, 0.5, 0.6);
    append(mesh, hull(0.36, 0.34, 0.4, 0.95));
    append(mesh, hull(0.34, 0.42, 0.95, 1.5));
    append(mesh, hull(0.22, 0.2, 1.52, vehicle.height));
    return mesh;
}

/// Glass: the cabin of a car, a band round larger ones.
Mesh cabinOf(const VehicleIdentity& vehicle) {
    if (vehicle.kind == "bicycle") return {};
    if (vehicle.kind == "car") return hull(0.56 * vehicle.length, 0.84 * vehicle.width, 0.92, vehicle.height);
    return hull(vehicle.length + 0.02, vehicle.width + 0.02, 1.15, 0.8 * vehicle.height);
}

}  // namespace

VehicleNodes::VehicleNodes(const recording::BakeDescription& description, const VehicleTracks& tracks,
                           std::uint32_t frames)
    : description_(description), tracks_(tracks), frames_(frames) {}

std::span<const float> VehicleNodes::at(std::uint32_t frame, std::size_t vehicle) const {
    return tracks_.places.subspan((frame * description_.vehicles.size() + vehicle) * kVehicleFloats,
                                  kVehicleFloats);
}

void VehicleNodes::addMeshes(GlbDocument& document) {
    if (empty()) return;
    const int glass = document.addMaterial("glass", colourFromHex(0x1b2228), 0.15);
    const int tyre = document.addMaterial("tyre", colourFromHex(0x1a1a1a), 0.9);
    for (const VehicleIdentity& vehicle : description_.vehicles) {
        if (std::ranges::find(looks_, vehicle.kind, &Look::kind) != looks_.end()) continue;
        Look look{vehicle.kind, -1, -1, -1, axlesOf(vehicle)};
        const auto add = [&](const std::string& part, const Mesh& mesh, int material) {
            return mesh.indices.empty() ? -1
                                        : document.addMesh(fmt::format("{} {}", vehicle.kind, part),
                                                           document.addGeometry(mesh), material);
        };
        look.body =
            add("body", bodyOf(vehicle), document.addMaterial(vehicle.kind, colourOf(vehicle.kind), 0.4));
        look.cabin = add("glass", cabinOf(vehicle), glass);
        look.axle = add("axle", axleMesh(vehicle), tyre);
        looks_.push_back(std::move(look));
    }
    if (tracks_.doors.empty()) return;
    for (const DoorIdentity& doors : description_.doors)
        if (!doors.at.empty()) leafMesh(document, doors.width);
}

int VehicleNodes::leafMesh(GlbDocument& document, double width) {
    const auto known = std::ranges::find(leaves_, width, &std::pair<double, int>::first);
    if (known != leaves_.end()) return known->second;
    const double x = 0.245 * width, y = 0.5 * kLeaf;
    const std::array<glm::dvec2, 4> outline{{{-x, -y}, {x, -y}, {x, y}, {-x, y}}};
    const int material = document.addMaterial("door", colourFromHex(0x23282d), 0.3);
    const Mesh mesh = raisedMesh(closedWallMesh(outline, kDoorTop - kDoorLow), kDoorLow);
    leaves_.emplace_back(width, document.addMesh("door", document.addGeometry(mesh), material));
    return leaves_.back().second;
}

std::vector<VehicleNodes::Leaf> VehicleNodes::leavesOf(std::size_t vehicle) const {
    std::vector<Leaf> leaves;
    if (tracks_.doors.empty()) return leaves;
    const VehicleIdentity& what = description_.vehicles[vehicle];
    const DoorIdentity& doors = description_.doors.at(vehicle);
    for (const DoorColumn side : {DoorColumn::left, DoorColumn::right}) {
        const bool is_left = side == DoorColumn::left;
        if (!(is_left ? doors.left : doors.right)) continue;
        for (const double at : doors.at)
            for (const double way : {-1.0, 1.0})
                leaves.push_back({0.5 * what.length - at + 0.25 * way * doors.width,
                                  (is_left ? 1.0 : -1.0) * (0.5 * what.width + kLeaf),
                                  0.48 * way * doors.width, side, doors.width});
    }
    return leaves;
}

void VehicleNodes::addDoors(GlbDocument& document, int node, std::size_t vehicle, int times) {
    for (const Leaf& leaf : leavesOf(vehicle)) {
        const int door =
            document.addPlacedNode(node, "door", leafMesh(document, leaf.width), {leaf.x, 0.0, -leaf.y});
        document.addSliding(door, times, frames_);
    }
}

void VehicleNodes::writeDoors(OutputFile& file, std::size_t vehicle) const {
    for (const Leaf& leaf : leavesOf(vehicle)) {
        std::vector<float> track;
        for (std::uint32_t frame = 0; frame < frames_; ++frame) {
            const std::size_t row = frame * description_.vehicles.size() + vehicle;
            const double open = double{doorIn(tracks_.doors, row, leaf.side)};
            track.insert(track.end(), {static_cast<float>(leaf.x + leaf.slides * open), 0.0f,
                                       static_cast<float>(-leaf.y)});
        }
        file.write(std::as_bytes(std::span(track)));
    }
}

const VehicleNodes::Look& VehicleNodes::lookOf(const VehicleIdentity& vehicle) const {
    return *std::ranges::find(looks_, vehicle.kind, &Look::kind);
}

void VehicleNodes::addNodes(GlbDocument& document, int times) {
    if (empty()) return;
    const int all = document.addEmptyNode("vehicles");
    for (std::size_t i = 0; i < description_.vehicles.size(); ++i) {
        const VehicleIdentity& vehicle = description_.vehicles[i];
        const Look& look = lookOf(vehicle);
        const int node = document.addAnimatedNode(all, fmt::format("{} {}", vehicle.kind, i), look.body, 1.0,
                                                  1.0, times, frames_, true);
        if (look.cabin >= 0) document.addPlacedNode(node, "glass", look.cabin, {0.0, 0.0, 0.0});
        for (const double x : look.axles) {
            const int axle = document.addPlacedNode(node, "axle", look.axle, {x, vehicle.wheel, 0.0});
            document.addTurning(axle, times, frames_);
        }
        addDoors(document, node, i, times);
    }
}

void VehicleNodes::writeTracks(OutputFile& file) const {
    if (empty()) return;
    for (std::size_t i = 0; i < description_.vehicles.size(); ++i) {
        writeTranslations(file, i);
        writeRotations(file, i, false);
        writeScales(file, i);
        for (std::size_t axle = 0; axle < lookOf(description_.vehicles[i]).axles.size(); ++axle)
            writeRotations(file, i, true);
        writeDoors(file, i);
    }
}

void VehicleNodes::writeTranslations(OutputFile& file, std::size_t vehicle) const {
    std::vector<float> track;
    for (std::uint32_t frame = 0; frame < frames_; ++frame) {
        const auto place = at(frame, vehicle);
        track.insert(track.end(), {place[0], place[2], -place[1]});
    }
    file.write(std::as_bytes(std::span(track)));
}

/// About +Y by the heading, or of wheels about their axles; consecutive keys take the nearer of two
/// quaternions.
void VehicleNodes::writeRotations(OutputFile& file, std::size_t vehicle, bool of_wheels) const {
    std::vector<std::int16_t> track;
    double last_sine = 0.0, last_cosine = 1.0;
    for (std::uint32_t frame = 0; frame < frames_; ++frame) {
        const auto place = at(frame, vehicle);
        const double angle = of_wheels ? -double{place[static_cast<std::size_t>(VehicleColumn::along)]} /
                                             description_.vehicles[vehicle].wheel
                                       : double{place[static_cast<std::size_t>(VehicleColumn::heading)]};
        double sine = std::sin(0.5 * angle), cosine = std::cos(0.5 * angle);
        if (sine * last_sine + cosine * last_cosine < 0.0) {
            sine = -sine;
            cosine = -cosine;
        }
        const auto key = [](double value) { return static_cast<std::int16_t>(std::lround(value * 32767.0)); };
        const std::int16_t turn = key(sine), none = 0;
        track.insert(track.end(), {none, of_wheels ? none : turn, of_wheels ? turn : none, key(cosine)});
        last_sine = sine;
        last_cosine = cosine;
    }
    file.write(std::as_bytes(std::span(track)));
}

void VehicleNodes::writeScales(OutputFile& file, std::size_t vehicle) const {
    std::vector<float> track;
    for (std::uint32_t frame = 0; frame < frames_; ++frame) {
        const bool there = at(frame, vehicle)[static_cast<std::size_t>(VehicleColumn::state)] != kVehicleAway;
        track.insert(track.end(), 3, there ? 1.0f : 0.0f);
    }
    file.write(std::as_bytes(std::span(track)));
}

}  // namespace throng::io
