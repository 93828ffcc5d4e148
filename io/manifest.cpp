// SPDX-License-Identifier: Apache-2.0
#include "io/manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "authoring/link_kinds.h"
#include "base/build_name.h"
#include "base/outcomes.h"
#include "io/door_file.h"
#include "io/lift_file.h"
#include "io/streams/stream_format.h"
#include "io/vehicle_file.h"

namespace throng::io {
namespace {

using Json = nlohmann::ordered_json;

Json pointToJson(glm::dvec2 point) {
    return Json::array({point.x, point.y});
}

Json pointsToJson(const std::vector<glm::dvec2>& points, glm::dvec2 origin) {
    Json list = Json::array();
    for (const glm::dvec2 point : points)
        list.push_back(pointToJson(point - origin));
    return list;
}

Json flightToJson(const recording::BakeFlight& flight, glm::dvec2 origin) {
    return {
        {"line", pointsToJson(flight.line, origin)}, {"heights", flight.heights}, {"width", flight.width}};
}

Json aisleToJson(const recording::BakeAisle& aisle, glm::dvec2 origin) {
    Json told = {{"line", pointsToJson(aisle.line, origin)}, {"width", aisle.width}};
    if (!aisle.heights.empty()) told["heights"] = aisle.heights;
    if (!aisle.passage) return told;
    told["passage"] = flightToJson(*aisle.passage, origin);
    told["flights"] = Json::array();
    for (const recording::BakeFlight& flight : aisle.flights)
        told["flights"].push_back(flightToJson(flight, origin));
    return told;
}

Json seatsToJson(const recording::BakeDescription& description) {
    Json list = Json::array();
    for (const recording::BakeSeats& seats : description.seats) {
        Json rows = Json::array();
        for (const recording::BakeSeatRow& row : seats.rows) {
            rows.push_back(
                {{"line", pointsToJson(row.line, description.output_origin)}, {"height", row.height}});
            if (!row.heights.empty()) rows.back()["heights"] = row.heights;
        }
        list.push_back({{"id", seats.id},
                        {"pitch", seats.pitch},
                        {"width", seats.width},
                        {"rise", seats.rise},
                        {"rows", std::move(rows)}});
        if (seats.ground) list.back()["ground"] = *seats.ground;
        for (const recording::BakeAisle& aisle : seats.aisles)
            list.back()["aisles"].push_back(aisleToJson(aisle, description.output_origin));
    }
    return list;
}

Json patchesToJson(const recording::BakeDescription& description) {
    Json list = Json::array();
    for (const authoring::Patch& patch : description.patches) {
        list.push_back({{"id", patch.id},
                        {"polygon", pointsToJson(patch.polygon, description.output_origin)},
                        {"cost", patch.cost},
                        {"pace", patch.pace},
                        {"from", patch.from}});
        if (patch.size != 1.0) list.back()["size"] = patch.size;
        if (patch.until) list.back()["until"] = *patch.until;
        if (!description.levels.empty()) list.back()["level"] = description.levels.at(patch.level).id;
    }
    return list;
}

Json geometryToJson(const recording::BakeDescription& description) {
    const glm::dvec2 origin = description.output_origin;
    Json geometry{{"walls", Json::array()}, {"roads", Json::array()}, {"areas", Json::array()}};
    for (std::size_t i = 0; i < description.walls.size(); ++i) {
        const authoring::Wall& wall = description.walls[i];
        geometry["walls"].push_back({{"id", wall.id},
                                     {"points", pointsToJson(wall.points, origin)},
                                     {"closed", wall.closed},
                                     {"thickness", wall.thickness},
                                     {"height", wall.height}});
        if (description.terrain)
            geometry["walls"].back()["ground"] = pointToJson(description.terrain->along_walls.at(i));
        if (wall.is_edge) geometry["walls"].back()["edge"] = true;
        if (!wall.toggles.empty())
            geometry["walls"].back()["gate"] = {{"open_at_start", wall.open_at_start},
                                                {"toggles", wall.toggles}};
    }
    for (const authoring::Road& road : description.roads)
        geometry["roads"].push_back({{"id", road.id},
                                     {"centreline", pointsToJson(road.centreline, origin)},
                                     {"width", road.width},
                                     {"one_way", road.one_way}});
    for (const authoring::Area& area : description.areas)
        geometry["areas"].push_back({{"id", area.id}, {"polygon", pointsToJson(area.polygon, origin)}});
    if (!description.patches.empty()) geometry["patches"] = patchesToJson(description);
    if (!description.seats.empty()) geometry["seats"] = seatsToJson(description);
    if (!description.traffic.empty()) geometry["traffic"] = trafficToJson(description.traffic, origin);
    if (description.levels.empty()) return geometry;
    for (std::size_t i = 0; i < description.roads.size(); ++i)
        geometry["roads"][i]["level"] = description.levels.at(description.roads[i].level).id;
    for (std::size_t i = 0; i < description.areas.size(); ++i)
        geometry["areas"][i]["level"] = description.levels.at(description.areas[i].level).id;
    return geometry;
}

const char* nameOf(Between between) {
    return between == Between::nearest ? "nearest" : between == Between::linear ? "linear" : "heading";
}

Json streamToJson(const StreamInfo& info, const StreamFormats& formats) {
    Json json;
    for (const StreamFormatInfo& format : kStreamFormats)
        if (formats.has(format.id)) json[std::string(format.name)] = streamFile(info, format.id);
    for (const StreamComponent& component : info.components) {
        json["components"].push_back(component.name);
        json["units"].push_back(component.unit);
        json["interpolation"].push_back(nameOf(component.between));
        if (formats.has(StreamFormat::packed))
            json["packed_error"].push_back(component.is_whole ? 0.0 : component.step / 2.0);
    }
    return json;
}

Json levelsToJson(const recording::BakeDescription& description) {
    Json list = Json::array();
    for (const authoring::Level& level : description.levels) {
        list.push_back({{"id", level.id},
                        {"height", level.height},
                        {"floor", pointsToJson(level.floor, description.output_origin)}});
        if (level.is_landing) list.back()["landing"] = true;
    }
    return list;
}

std::string_view nameOf(authoring::Link::Kind kind) {
    return std::ranges::find_if(authoring::kLinkKinds,
                                [&](const auto& known) { return known.second == kind; })
        ->first;
}

Json linksToJson(const recording::BakeDescription& description) {
    Json list = Json::array();
    for (const authoring::Link& link : description.links) {
        list.push_back({{"id", link.id},
                        {"type", nameOf(link.kind)},
                        {"from", description.levels.at(link.from).id},
                        {"to", description.levels.at(link.to).id},
                        {"path", pointsToJson({link.begin, link.end}, description.output_origin)},
                        {"width", link.width}});
        if (link.heights) list.back()["heights"] = {link.heights->x, link.heights->y};
    }
    return list;
}

/// @param storeys whether people walk on several surfaces above each other
Json terrainToJson(const recording::BakeTerrain& terrain, bool storeys) {
    const auto [low, high] =
        std::minmax_element(terrain.mesh->positions.begin(), terrain.mesh->positions.end(),
                            [](const glm::dvec3& a, const glm::dvec3& b) { return a.z < b.z; });
    return {{"file", "terrain.glb"},
            {"source", terrain.source},
            {"hash", "xxh3:" + terrain.hash},
            {"surface", terrain.is_cut               ? "grounds"
                        : storeys                    ? "levels"
                        : terrain.surface->highest() ? "highest"
                                                     : "lowest"},
            {"triangles", terrain.mesh->indices.size() / 3},
            {"lowest", low->z},
            {"highest", high->z}};
}

Json accountToJson(const AccountTotals& account) {
    return {{"agents", account.agents},
            {keyFor(Fate::spawned), account.spawned},
            {keyFor(Fate::walking), account.walking},
            {keyFor(Fate::arrived), account.arrived},
            {keyFor(Fate::refused), account.refused},
            {"refused_reasons",
             account.refused_reasons.empty() ? Json::object() : Json(account.refused_reasons)}};
}

/// Each chart's picture in the file of several parts, and where the chart lies in the plane.
Json storeysToJson(const recording::BakeCharts& charts) {
    Json parts = Json::array();
    for (std::size_t i = 0; i < charts.pictures.size(); ++i) {
        const recording::BakeCharts::Picture& picture = charts.pictures[i];
        parts.push_back({{"name", picture.name},
                         {"kind", picture.kind},
                         {"level", picture.level},
                         {"lowest", picture.lowest},
                         {"highest", picture.highest},
                         {"shift", pointToJson(charts.shifts[i])}});
    }
    return {{"pattern", "diagrams/storeys.####.exr"}, {"parts", parts}};
}

Json diagramsToJson(const recording::BakeDescription& description,
                    const std::optional<DiagramSummary>& diagrams) {
    if (!diagrams) return nullptr;
    Json json{{"pattern", "diagrams/diagram.####.exr"},
              {"every", description.diagram_every},
              {"count", diagrams->count},
              {"width", diagrams->width},
              {"height", diagrams->height},
              {"pixels_per_metre", diagrams->pixels_per_metre},
              {"min", pointToJson(diagrams->minimum)}};
    if (description.charts) json["storeys"] = storeysToJson(*description.charts);
    return json;
}

Json gltfToJson(const std::optional<GltfSummary>& gltf) {
    if (!gltf) return nullptr;
    return {{"file", "crowd.glb"}, {"agents", gltf->agents}, {"of", gltf->of}};
}

Json timingToJson(const BakeTiming& timing) {
    const double rate =
        timing.wall_seconds > 0.0 ? static_cast<double>(timing.steps) / timing.wall_seconds : 0.0;
    return {{"wall_seconds", timing.wall_seconds}, {"steps", timing.steps}, {"steps_per_second", rate}};
}

/// Their numbers, in order: renderers need not make the poses of the others.
Json gaitsToJson(std::uint32_t gaits) {
    Json list = Json::array();
    for (int gait = 0; gaits >> gait != 0; ++gait)
        if (gaits >> gait & 1u) list.push_back(gait);
    return list;
}

/// Which layout this is: what there is of it here, and what that was made from.
Json layoutToJson(const recording::BakeDescription& description) {
    Json json{{"file", "layout.json"}, {"hash", "xxh3:" + hashText(description.layout_text)}};
    const recording::LayoutSource& source = description.source;
    if (!source.file.empty()) json["source"] = {{"file", source.file}, {"hash", "xxh3:" + source.hash}};
    if (!source.overrides.empty()) json["overrides"] = source.overrides;
    return json;
}

Json filesToJson(const std::vector<BakeOutcome::File>& files) {
    Json list = Json::array();
    for (const BakeOutcome::File& file : files)
        list.push_back({{"path", file.path}, {"bytes", file.hash.bytes}, {"xxh3", file.hash.xxh3}});
    return list;
}

constexpr const char* kChecksum = "checksum";
constexpr std::string_view kHashName = "xxh3:", kNoDigits = "0000000000000000";

bool isHash(std::string_view text) {
    return text.size() == kHashName.size() + kNoDigits.size() && text.starts_with(kHashName) &&
           std::ranges::all_of(text.substr(kHashName.size()),
                               [](unsigned char c) { return std::isxdigit(c); });
}

/// Where a text that manifestText() made has its checksum's value: a damaged name of it hides nothing.
std::string_view hashAtTheEnd(std::string_view text) {
    constexpr std::string_view kEnd = "\"\n}\n";
    const std::size_t length = kHashName.size() + kNoDigits.size();
    if (!text.ends_with(kEnd) || text.size() < length + kEnd.size()) return {};
    return text.substr(text.size() - kEnd.size() - length, length);
}

}  // namespace

Json streamsToJson(const StreamChoice& streams, const StreamFormats& formats) {
    Json json;
    for (const StreamInfo& info : kStreams)
        if (streams[info.id]) json[std::string(info.name)] = streamToJson(info, formats);
    return json;
}

std::string manifestText(Json manifest) {
    manifest.erase(kChecksum);
    manifest[kChecksum] = fmt::format("{}{}", kHashName, kNoDigits);
    std::string text = manifest.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    return text.replace(text.rfind(kNoDigits), kNoDigits.size(), hashText(text));
}

OwnChecksum checkManifest(std::string text, const Json& manifest) {
    const bool has_member = manifest.is_object() && manifest.contains(kChecksum);
    if (!has_member) return isHash(hashAtTheEnd(text)) ? OwnChecksum::wrong : OwnChecksum::absent;
    const Json& value = manifest[kChecksum];
    const std::string told = value.is_string() ? value.get<std::string>() : "";
    const std::size_t at = isHash(told) ? text.rfind(told) : std::string::npos;
    if (at == std::string::npos) return OwnChecksum::wrong;
    text.replace(at + kHashName.size(), kNoDigits.size(), kNoDigits);
    return hashText(text) == told.substr(kHashName.size()) ? OwnChecksum::fits : OwnChecksum::wrong;
}

Json bakeManifest(const recording::BakeDescription& description, const BakeOutcome& outcome) {
    const glm::dvec2 origin = description.output_origin;
    Json json;
    json["format"] = "throng bake";
    json["version"] = 1;
    json["generator"] = "throng " THRONG_VERSION;
    json["build"] = buildName();
    json["name"] = description.name;
    json["complete"] = outcome.complete;
    json["layout"] = layoutToJson(description);
    if (!description.inputs.empty()) json["inputs"] = "xxh3:" + description.inputs;
    json["seed"] = description.seed;
    json["fps"] = description.fps;
    json["frames"] = outcome.frames;
    json["frame_start"] = 1;
    json["substeps"] = description.substeps;
    json["duration"] = description.duration;
    json["warmup"] = description.warmup;
    json["agents"] = description.agents.size();
    json["variations"] = description.variations;
    json["strides"] = description.strides;
    json["gaits"] = gaitsToJson(outcome.gaits);
    if (description.has_poses) json["poses"] = true;
    json["units"] = "metres";
    json["up_axis"] = "Z";
    json["origin"] = {origin.x, origin.y, 0.0};
    json["bounds"] = {{"min", pointToJson(description.minimum - origin)},
                      {"max", pointToJson(description.maximum - origin)}};
    json["streams"] = streamsToJson(description.streams(), description.formats);
    if (description.terrain)
        json["terrain"] = terrainToJson(*description.terrain, !description.levels.empty());
    if (!description.levels.empty()) json["levels"] = levelsToJson(description);
    if (!description.links.empty()) json["links"] = linksToJson(description);
    if (!description.lifts.empty()) json["lifts"] = liftsToJson(liftsOf(description));
    if (!description.vehicles.empty()) json["vehicles"] = vehiclesToJson(description.vehicles);
    if (!description.doors.empty()) json["doors"] = doorsToJson(description.doors);
    json["table"] = "agents.csv";
    json["gltf"] = gltfToJson(outcome.gltf);
    json["diagrams"] = diagramsToJson(description, outcome.diagrams);
    json["geometry"] = geometryToJson(description);
    json["account"] = accountToJson(outcome.account);
    json["device"] = {{"renderer", description.renderer}, {"driver", description.driver}};
    json["timing"] = timingToJson(outcome.timing);
    json["files"] = filesToJson(outcome.files);
    return json;
}

}  // namespace throng::io
