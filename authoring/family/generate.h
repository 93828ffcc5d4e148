// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "authoring/family/generators.h"

/// What the generators share.
namespace throng::authoring::generate {

using Json = nlohmann::ordered_json;

/// m, rounded to millimetres, so that layouts stay readable and the same everywhere.
inline double rounded(double metres) {
    return std::round(metres * 1000.0) / 1000.0 + 0.0;
}
inline Json point(glm::dvec2 p) {
    return Json::array({rounded(p.x), rounded(p.y)});
}
inline Json points(const std::vector<glm::dvec2>& line) {
    Json list = Json::array();
    for (const glm::dvec2 p : line)
        list.push_back(point(p));
    return list;
}
inline Json rectangle(double x0, double y0, double x1, double y1) {
    return points({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

/// A place on a circle round the origin, counter-clockwise from x. @param angle rad
inline glm::dvec2 onCircle(double radius, double angle) {
    return radius * glm::dvec2(std::cos(angle), std::sin(angle));
}
/// A part of a ring round the origin, counter-clockwise, in so many straight pieces. @param step rad
std::vector<glm::dvec2> sector(double inner, double outer, double from, double step, int pieces);

/// The nearest of some places, or the only one.
inline Json nearestOf(const Json& places) {
    return places.size() > 1 ? Json{{"nearest", places}} : places[0];
}
/// The share of one of several, so that all of them make the whole.
inline std::uint64_t shareOf(std::uint64_t whole, std::uint64_t number, std::uint64_t of) {
    return whole * (number + 1) / of - whole * number / of;
}

/// Where the streets of one direction run, each in the middle of its width, and where the blocks between them
/// begin and end.
struct StreetLines {
    std::vector<double> streets;
    std::vector<std::pair<double, double>> blocks;
    double end = 0.0;
};
/// One street more than there are blocks. @param values with `block` and `width`
/// @param which tells the draws of one direction from the other's
StreetLines layStreets(std::uint64_t blocks, const GeneratorValues& values, const char* which);

/// The houses between streets, as closed walls.
void addBlocks(Json& layout, const StreetLines& across, const StreetLines& along);

/// What every layout begins with.
Json frameOf(const std::string& name, const GeneratorValues& values);

/// Discs that keep people's ways open: each at least `gap` from the others and from whatever `fits` refuses.
std::vector<glm::dvec2> scatter(std::size_t count, glm::dvec2 minimum, glm::dvec2 maximum, double gap,
                                std::uint64_t seed, bool (*fits)(glm::dvec2, const void*),
                                const void* context);
/// Round pillars as closed walls.
void addPillars(Json& layout, const std::vector<glm::dvec2>& centres, double radius);

Json crossing(const GeneratorValues& values);
Json corridor(const GeneratorValues& values);
Json streets(const GeneratorValues& values);
Json marathon(const GeneratorValues& values);
Json plaza(const GeneratorValues& values);
Json stadium(const GeneratorValues& values);
/// A stadium with seats.
Json stadiumOfStands(const GeneratorValues& values);
Json station(const GeneratorValues& values);
Json office(const GeneratorValues& values);

}  // namespace throng::authoring::generate
