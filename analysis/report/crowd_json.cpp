// SPDX-License-Identifier: Apache-2.0
#include "analysis/report/crowd_json.h"

#include <fmt/format.h>

#include <cmath>

#include "base/palette.h"
#include "io/storeys.h"

namespace throng::analysis {
namespace {

using Json = nlohmann::ordered_json;

Json pointsOf(const std::vector<glm::dvec2>& points) {
    Json list = Json::array();
    for (const glm::dvec2 point : points) {
        list.push_back(std::round(point.x * 1000.0) / 1000.0);
        list.push_back(std::round(point.y * 1000.0) / 1000.0);
    }
    return list;
}

/// Floors, links between them, and on which level everything else is.
void addLevels(const io::Bake& bake, Json& geometry) {
    for (const authoring::Level& level : bake.levels)
        geometry["levels"].push_back(
            {{"id", level.id}, {"height", level.height}, {"points", pointsOf(level.floor)}});
    geometry["links"] = Json::array();
    for (const authoring::Link& link : bake.links)
        geometry["links"].push_back({{"id", link.id}, {"levels", {link.from, link.to}}});
    for (std::size_t i = 0; i < bake.roads.size(); ++i)
        geometry["roads"][i]["levels"] = {bake.roads[i].level};
    for (std::size_t i = 0; i < bake.areas.size(); ++i)
        geometry["areas"][i]["levels"] = {bake.areas[i].level};
    const io::Storeys storeys(bake);
    for (std::size_t i = 0; i < bake.walls.size(); ++i) {
        Json& levels = geometry["walls"][i]["levels"] = Json::array();
        for (std::size_t level = 0; level < bake.levels.size(); ++level)
            if (storeys.isWallBeside(level, i)) levels.push_back(level);
    }
}

Json geometryOf(const io::Bake& bake) {
    Json geometry = {{"roads", Json::array()}, {"areas", Json::array()}, {"walls", Json::array()}};
    for (const authoring::Road& road : bake.roads)
        geometry["roads"].push_back(
            {{"id", road.id}, {"width", road.width}, {"points", pointsOf(road.centreline)}});
    for (const authoring::Area& area : bake.areas)
        geometry["areas"].push_back({{"id", area.id}, {"points", pointsOf(area.polygon)}});
    for (const authoring::Wall& wall : bake.walls)
        geometry["walls"].push_back({{"id", wall.id},
                                     {"closed", wall.closed},
                                     {"width", wall.thickness},
                                     {"points", pointsOf(wall.points)},
                                     {"open", wall.open_at_start},
                                     {"toggles", wall.toggles}});
    for (const authoring::Lane& lane : bake.traffic.lanes)
        geometry["lanes"].push_back({{"width", lane.width}, {"points", pointsOf(lane.points)}});
    for (const authoring::Zebra& crossing : bake.traffic.crossings)
        geometry["crossings"].push_back({{"points", pointsOf(crossing.polygon)}});
    if (bake.hasStoreys()) addLevels(bake, geometry);
    return geometry;
}

std::string hexOf(const Colour& colour) {
    const auto part = [](double value) { return static_cast<int>(std::lround(255.0 * value)); };
    return fmt::format("#{:02x}{:02x}{:02x}", part(colour.red), part(colour.green), part(colour.blue));
}

}  // namespace

Json crowdJson(const io::Bake& bake, const io::GroupTable& groups) {
    Json colours = Json::array();
    for (std::size_t group = 0; group < groups.names.size(); ++group)
        colours.push_back(hexOf(groupColour(group)));
    return {{"name", bake.name},
            {"fps", bake.fps},
            {"frames", bake.frames},
            {"minimum", {bake.minimum.x, bake.minimum.y}},
            {"maximum", {bake.maximum.x, bake.maximum.y}},
            {"geometry", geometryOf(bake)},
            {"groups", groups.names},
            {"colours", std::move(colours)}};
}

}  // namespace throng::analysis
