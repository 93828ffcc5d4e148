// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/crowd_glb.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/files/output_file.h"
#include "base/palette.h"
#include "io/gltf/animation_tracks.h"
#include "io/gltf/glb_document.h"
#include "io/gltf/meshes.h"
#include "io/gltf/vehicle_nodes.h"
#include "io/gltf/zebra.h"

namespace throng::io {
namespace {

constexpr double kGroundMargin = 5.0;  // m
// Flat surfaces lie a little above each other, or renderers could not tell which one is on top.
constexpr double kAreaHeight = 0.01;                    // m
constexpr double kRoadHeight = 0.02;                    // m
constexpr double kLaneHeight = 0.015;                   // m
constexpr double kStripeHeight = 0.025, kStripe = 0.5;  // m: a zebra's, and how wide

constexpr double kSeat = 0.42, kBench = 0.4;  // m: high and deep
constexpr double kTread = 0.15;               // m: rows over passages are so thick

constexpr std::uint64_t kLargestTracks = std::uint64_t{2'000} << 20;

std::vector<glm::dvec2> relative(const std::vector<glm::dvec2>& points, glm::dvec2 origin) {
    std::vector<glm::dvec2> result = points;
    for (glm::dvec2& point : result)
        point -= origin;
    return result;
}

Mesh terrainMesh(const recording::BakeDescription& description) {
    const authoring::TerrainMesh& terrain = *description.terrain->mesh;
    Mesh mesh;
    mesh.positions.reserve(terrain.positions.size());
    for (const glm::dvec3& position : terrain.positions)
        mesh.positions.emplace_back(position - glm::dvec3(description.output_origin, 0.0));
    mesh.normals = terrain.normals;
    mesh.indices = terrain.indices;
    return mesh;
}

GlbDocument documentFor(const recording::BakeDescription& description) {
    return {description.name, {description.output_origin.x, 0.0, -description.output_origin.y}};
}

/// From below the lowest ground along a wall to its height over the highest.
void addWalls(GlbDocument& document, const recording::BakeDescription& description) {
    const int material = document.addMaterial("wall", colourFromHex(0xcfc8bb), 0.8);
    for (std::size_t i = 0; i < description.walls.size(); ++i) {
        const authoring::Wall& wall = description.walls[i];
        if (wall.is_edge) continue;
        const std::vector<glm::dvec2> points = relative(wall.points, description.output_origin);
        const glm::dvec2 ground =
            description.terrain ? description.terrain->along_walls.at(i) : glm::dvec2(0.0);
        const double height = wall.height + ground.y - ground.x;
        document.addMeshNode("wall " + wall.id,
                             raisedMesh(wall.closed ? closedWallMesh(points, height)
                                                    : openWallMesh(points, wall.thickness, height),
                                        ground.x),
                             material);
    }
}

/// People may walk under such a stand.
bool hasPassages(const recording::BakeSeats& seats) {
    return !seats.aisles.empty() && seats.aisles.front().passage;
}

/// Piece by piece, from below the lowest ground up.
void addRowOnTerrain(const recording::BakeSeatRow& row, const std::vector<glm::dvec2>& line,
                     const recording::BakeSeats& seats, Mesh& steps, Mesh& benches) {
    constexpr double kIntoGround = 0.3;  // m
    const double bottom = *seats.ground - kIntoGround;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const std::array piece{line[i], line[i + 1]};
        const double height = row.heights.empty() ? row.height : 0.5 * (row.heights[i] + row.heights[i + 1]);
        if (height > bottom)
            append(steps, raisedMesh(openWallMesh(piece, seats.pitch, height - bottom), bottom));
        append(benches, raisedMesh(openWallMesh(piece, kBench, kSeat), height));
    }
}

/// A step for each row of seats, and a bench on it.
void addStands(GlbDocument& document, const recording::BakeDescription& description) {
    if (description.seats.empty()) return;
    const int stone = document.addMaterial("stand", colourFromHex(0x8f8d88), 0.9);
    const int shell = document.addMaterial("seats", colourFromHex(0x38587f), 0.5);
    for (const recording::BakeSeats& seats : description.seats) {
        Mesh steps, benches;
        for (const recording::BakeSeatRow& row : seats.rows) {
            const std::vector<glm::dvec2> line = relative(row.line, description.output_origin);
            if (seats.ground) {
                addRowOnTerrain(row, line, seats, steps, benches);
                continue;
            }
            if (hasPassages(seats))
                append(steps, raisedMesh(openWallMesh(line, seats.pitch, seats.rise + kTread),
                                         row.height - seats.rise - kTread));
            else if (row.height > kAreaHeight)
                append(steps, openWallMesh(line, seats.pitch, row.height));
            append(benches, raisedMesh(openWallMesh(line, kBench, kSeat), row.height));
        }
        document.addMeshNode("stand " + seats.id, steps, stone);
        document.addMeshNode("seats " + seats.id, benches, shell);
    }
}

void addStreet(GlbDocument& document, const authoring::Traffic& traffic, glm::dvec2 origin) {
    if (traffic.empty()) return;
    const int lane = document.addMaterial("lane", colourFromHex(0x55565a), 0.9);
    const int paint = document.addMaterial("crossing", colourFromHex(0xa9a9a4), 0.9);
    for (const authoring::Lane& entry : traffic.lanes)
        document.addMeshNode("lane " + entry.id,
                             ribbonMesh(relative(entry.points, origin), entry.width, kLaneHeight), lane);
    for (const authoring::Zebra& entry : traffic.crossings) {
        glm::dvec2 middle(0.0);
        for (const glm::dvec2 point : entry.polygon)
            middle += point / static_cast<double>(entry.polygon.size());
        Mesh stripes;
        for (const std::vector<glm::dvec2>& stripe :
             zebraStripes(relative(entry.polygon, origin), wayBeside(traffic.lanes, middle), kStripe))
            append(stripes, polygonMesh(stripe, kStripeHeight));
        document.addMeshNode("crossing " + entry.id,
                             polygonMesh(relative(entry.polygon, origin), kRoadHeight), lane);
        document.addMeshNode("stripes " + entry.id, stripes, paint);
    }
}

/// A terrain takes the place of the ground, and of roads and areas, which are flat.
void addScenery(GlbDocument& document, const recording::BakeDescription& description) {
    const glm::dvec2 origin = description.output_origin;
    const int ground = document.addMaterial("ground", colourFromHex(0x9a978f), 0.95);
    addStands(document, description);
    if (description.terrain) {
        document.addMeshNode("ground", terrainMesh(description), ground);
        return addWalls(document, description);
    }
    const int area = document.addMaterial("area", colourFromHex(0x86837b), 0.9);
    const int road = document.addMaterial("road", colourFromHex(0x6b6a68), 0.85);
    document.addMeshNode("ground",
                         groundMesh(description.minimum - origin - kGroundMargin,
                                    description.maximum - origin + kGroundMargin, 0.0),
                         ground);
    for (const authoring::Area& entry : description.areas)
        document.addMeshNode("area " + entry.id, polygonMesh(relative(entry.polygon, origin), kAreaHeight),
                             area);
    addStreet(document, description.traffic, origin);
    for (const authoring::Road& entry : description.roads)
        document.addMeshNode("road " + entry.id,
                             ribbonMesh(relative(entry.centreline, origin), entry.width, kRoadHeight), road);
    addWalls(document, description);
}

/// One mesh for each group, as they differ in colour, and for each colour of its own; the geometry is stored
/// once.
struct Bodies {
    std::vector<int> of_groups;
    std::map<std::uint32_t, int> of_colours;

    int of(const recording::BakeAgent& agent) const {
        return agent.colour ? of_colours.at(*agent.colour) : of_groups.at(agent.group);
    }
};

Bodies addBodies(GlbDocument& document, const recording::BakeDescription& description,
                 const std::vector<TrackRow>& rows) {
    Bodies bodies;
    if (description.agents.empty()) return bodies;
    const GlbDocument::Geometry body = document.addGeometry(bodyMesh());
    const auto add = [&](const std::string& name, Colour colour) {
        return document.addMesh(name, body, document.addMaterial(name, colour, 0.7));
    };
    for (std::size_t group = 0; group < description.groups.size(); ++group)
        bodies.of_groups.push_back(add(description.groups[group].id, groupColour(group)));
    for (const TrackRow& row : rows)
        if (const auto colour = description.agents.at(row.row).colour;
            colour && !bodies.of_colours.contains(*colour))
            bodies.of_colours[*colour] = add(fmt::format("#{:06x}", *colour), colourFromHex(*colour));
    return bodies;
}

std::vector<std::uint32_t> chooseRows(std::uint32_t rows, std::uint32_t frames, std::uint32_t cap) {
    std::uint64_t count = std::min(rows, cap);
    if (frames == 0) count = 0;
    if (frames > 0) count = std::min(count, kLargestTracks / (std::uint64_t{frames} * kLargestKeyBytes));
    std::vector<std::uint32_t> chosen;
    for (std::uint64_t i = 0; i < count; ++i)
        chosen.push_back(static_cast<std::uint32_t>(i * rows / count));
    return chosen;
}

void addPeople(GlbDocument& document, const recording::BakeDescription& description,
               const std::vector<TrackRow>& rows, std::uint32_t frames, VehicleNodes& vehicles,
               LiftNodes& lifts) {
    const Bodies bodies = addBodies(document, description, rows);
    vehicles.addMeshes(document);
    lifts.addMeshes(document);
    if (rows.empty() && vehicles.empty() && lifts.empty()) return;
    const int people = rows.empty() ? -1 : document.addEmptyNode("people");
    const int times = document.addTimes(frames, description.fps);
    for (const TrackRow& row : rows) {
        const std::string name = "person " + std::to_string(row.row);
        const int body = bodies.of(description.agents.at(row.row));
        const auto& [x, y, z] = row.place;
        if (row.stays)
            document.addSeatedNode(people, name, body, {double{x}, double{z}, -double{y}},
                                   std::atan2(row.direction[1], row.direction[0]), times, frames);
        else
            document.addAnimatedNode(people, name, body, row.width_scale, row.height_scale, times, frames,
                                     row.has_scales);
    }
    vehicles.addNodes(document, times);
    lifts.addNodes(document, times);
}

}  // namespace

GltfSummary writeCrowdGlb(const std::filesystem::path& path, const recording::BakeDescription& description,
                          const StreamSet& streams, const MovingTracks& moving) {
    const std::uint32_t frames = streams.frames();
    const std::uint32_t all_rows = streams.rows();
    std::vector<TrackRow> rows;
    for (const std::uint32_t row : chooseRows(all_rows, frames, description.gltf_agents)) {
        const recording::BakeAgent& agent = description.agents.at(row);
        rows.push_back({row, static_cast<float>(agent.scale * agent.radius / kBodyRadius),
                        static_cast<float>(agent.scale), false});
    }
    findScaledRows(streams, rows);

    GlbDocument document = documentFor(description);
    addScenery(document, description);
    VehicleNodes vehicles(description, moving.vehicles, frames);
    LiftNodes lifts(moving.lifts, frames);
    addPeople(document, description, rows, frames, vehicles, lifts);

    OutputFile file(path);
    document.writeHead(file);
    writeTracks(file, streams, rows);
    vehicles.writeTracks(file);
    lifts.writeTracks(file);
    if (file.position() != document.fileSize())
        throw OutputError(path, "came out with another size than its header says");
    file.finish();
    return {static_cast<std::uint32_t>(rows.size()), all_rows};
}

void writeTerrainGlb(const std::filesystem::path& path, const recording::BakeDescription& description) {
    GlbDocument document = documentFor(description);
    document.addMeshNode("terrain", terrainMesh(description),
                         document.addMaterial("ground", colourFromHex(0x9a978f), 0.95));
    OutputFile file(path);
    document.writeHead(file);
    file.finish();
}

}  // namespace throng::io
