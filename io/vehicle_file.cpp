// SPDX-License-Identifier: Apache-2.0
#include "io/vehicle_file.h"

#include <algorithm>
#include <glm/common.hpp>

#include "io/streams/track_file.h"

namespace throng::io {
namespace {

using Json = nlohmann::ordered_json;

Json pointsToJson(const std::vector<glm::dvec2>& points, glm::dvec2 origin) {
    Json list = Json::array();
    for (const glm::dvec2 point : points)
        list.push_back({point.x - origin.x, point.y - origin.y});
    return list;
}

template <class Named>
Json namesToJson(const std::vector<std::size_t>& indices, const std::vector<Named>& things) {
    Json list = Json::array();
    for (const std::size_t index : indices)
        list.push_back(things.at(index).id);
    return list;
}

Json signalToJson(const authoring::Signal& signal, const authoring::Traffic& traffic) {
    Json phases = Json::array();
    for (const authoring::Phase& phase : signal.phases)
        phases.push_back({{"name", phase.name},
                          {"seconds", phase.seconds},
                          {"crossings", namesToJson(phase.crossings, traffic.crossings)},
                          {"lanes", namesToJson(phase.lanes, traffic.lanes)}});
    return {{"id", signal.id}, {"offset", signal.offset}, {"phases", std::move(phases)}};
}

Json laneToJson(const authoring::Lane& lane, const authoring::Traffic& traffic, glm::dvec2 origin) {
    Json stops = Json::array();
    for (const authoring::LaneStop& stop : lane.stops) {
        stops.push_back({{"at", pointsToJson({stop.at}, origin).front()}});
        if (stop.signal)
            stops.back()["signal"] = traffic.signals.at(*stop.signal).id;
        else if (stop.platform)
            stops.back()["platform"] = stop.platform->id;
        else
            stops.back()["seconds"] = stop.seconds;
    }
    return {{"id", lane.id},
            {"points", pointsToJson(lane.points, origin)},
            {"width", lane.width},
            {"stops", std::move(stops)}};
}

}  // namespace

std::vector<float> placedVehicles(const recording::BakeDescription& description, std::span<const float> track,
                                  std::uint32_t frames) {
    const std::size_t values = frames * description.vehicles.size() * kVehicleFloats;
    const std::span<const float> known = track.first(std::min(track.size(), values));
    std::vector<float> placed(known.begin(), known.end());
    placed.resize(values);
    const glm::dvec2 shift = description.scene_origin - description.output_origin;
    const auto& grounds = description.vehicle_grounds;
    for (std::size_t at = 0; at < placed.size(); at += kVehicleFloats) {
        if (placed[at + static_cast<std::size_t>(VehicleColumn::state)] == kVehicleAway) continue;
        glm::dvec2 place(placed[at], placed[at + 1]), on_ground = place;
        if (!grounds.empty()) {
            const auto& ground = grounds[at / kVehicleFloats % grounds.size()];
            on_ground = glm::clamp(place, ground.lower, ground.upper);
            place -= ground.shift;
        }
        if (description.terrain)
            placed[at + 2] = description.terrain->surface->heightAt(glm::vec2(on_ground));
        placed[at] = static_cast<float>(place.x + shift.x);
        placed[at + 1] = static_cast<float>(place.y + shift.y);
    }
    return placed;
}

void writeVehicles(const std::filesystem::path& path, std::span<const float> placed, std::uint32_t frames,
                   std::size_t vehicles) {
    writeTrack(path, placed, {frames, vehicles, kVehicleFloats});
}

std::vector<float> readVehicles(const Bake& bake) {
    return readTrack(bake.folder / kVehicleFile, {bake.frames, bake.vehicles.size(), kVehicleFloats},
                     "vehicles");
}

Json vehiclesToJson(const std::vector<VehicleIdentity>& vehicles) {
    Json list = Json::array();
    for (const VehicleIdentity& vehicle : vehicles)
        list.push_back({{"flow", vehicle.flow},
                        {"kind", vehicle.kind},
                        {"length", vehicle.length},
                        {"width", vehicle.width},
                        {"height", vehicle.height},
                        {"wheel", vehicle.wheel}});
    return {{"file", kVehicleFile}, {"columns", kVehicleColumns}, {"list", std::move(list)}};
}

Json trafficToJson(const authoring::Traffic& traffic, glm::dvec2 origin) {
    Json json{{"crossings", Json::array()}, {"lanes", Json::array()}, {"signals", Json::array()}};
    for (const authoring::Zebra& crossing : traffic.crossings)
        json["crossings"].push_back(
            {{"id", crossing.id}, {"polygon", pointsToJson(crossing.polygon, origin)}});
    for (const authoring::Lane& lane : traffic.lanes)
        json["lanes"].push_back(laneToJson(lane, traffic, origin));
    for (const authoring::Signal& signal : traffic.signals)
        json["signals"].push_back(signalToJson(signal, traffic));
    return json;
}

}  // namespace throng::io
