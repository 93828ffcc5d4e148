// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "authoring/family/generate.h"

namespace throng::authoring::generate {
namespace {

constexpr double kWall = 0.3;     // m thick
constexpr double kOutside = 4.0;  // m, depth of the areas beyond openings
constexpr double kPass = 1.4;     // m, what is left between pillars, and before openings

/// A straight wall with an opening in its middle, and the area beyond it.
struct Side {
    glm::dvec2 a, b;  // its ends, counter-clockwise
    double opening;   // m

    glm::dvec2 along() const { return (b - a) / length(); }
    double length() const { return std::hypot(b.x - a.x, b.y - a.y); }
    glm::dvec2 outward() const { return {along().y, -along().x}; }
    glm::dvec2 middle() const { return 0.5 * (a + b); }

    void addTo(Json& layout, std::size_t number) const {
        const glm::dvec2 half = 0.5 * opening * along();
        for (const auto& [name, from, to] :
             {std::tuple{"a", a, middle() - half}, std::tuple{"b", middle() + half, b}})
            layout["walls"].push_back({{"id", fmt::format("wall {}{}", number, name)},
                                       {"thickness", kWall},
                                       {"points", points({from, to})}});
        const glm::dvec2 near = middle() + outward() * (0.5 * kWall + 1.0);
        const glm::dvec2 far = near + outward() * kOutside;
        const glm::dvec2 wide = 0.5 * std::max(opening, 2.0) * along();
        layout["areas"].push_back({{"id", fmt::format("exit {}", number)},
                                   {"polygon", points({near - wide, near + wide, far + wide, far - wide})}});
    }
};

/// A regular polygon round the origin, counter-clockwise, one opening a side.
std::vector<Side> ring(std::uint64_t sides, double radius, double opening) {
    std::vector<Side> found;
    const double step = 2.0 * std::numbers::pi / static_cast<double>(sides);
    for (std::uint64_t i = 0; i < sides; ++i) {
        const double from = (static_cast<double>(i) - 0.5) * step;
        found.push_back({onCircle(radius, from), onCircle(radius, from + step), opening});
    }
    return found;
}

std::vector<glm::dvec2> polygon(std::uint64_t sides, double radius) {
    std::vector<glm::dvec2> outline;
    for (std::uint64_t i = 0; i < sides; ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(sides);
        outline.push_back(onCircle(radius, angle));
    }
    return outline;
}

}  // namespace

std::vector<glm::dvec2> sector(double inner, double outer, double from, double step, int pieces) {
    std::vector<glm::dvec2> outline;
    for (int i = 0; i <= pieces; ++i)
        outline.push_back(onCircle(outer, from + step * i / pieces));
    for (int i = pieces; i >= 0; --i)
        outline.push_back(onCircle(inner, from + step * i / pieces));
    return outline;
}

Json plaza(const GeneratorValues& values) {
    const std::uint64_t exits = values.whole("exits");
    // Two openings face each other across a square; more have a side each.
    const std::uint64_t sides = std::max<std::uint64_t>(exits, 4);
    const double radius = 0.5 * values["size"] / std::cos(std::numbers::pi / static_cast<double>(sides));
    const double side_length = 2.0 * radius * std::sin(std::numbers::pi / static_cast<double>(sides));
    const double opening = std::min(values["exit_width"], 0.6 * side_length);
    Json layout = frameOf("plaza", values);
    std::vector<Side> walls = ring(sides, radius, opening);
    std::vector<Side> open;
    for (std::size_t i = 0; i < walls.size(); ++i) {
        if (exits >= 4 || i % 2 == 0 || (exits == 3 && i == 1)) {
            open.push_back(walls[i]);
            walls[i].addTo(layout, open.size());
        } else {
            layout["walls"].push_back({{"id", fmt::format("closed wall {}", i + 1)},
                                       {"thickness", kWall},
                                       {"points", points({walls[i].a, walls[i].b})}});
        }
    }
    struct Room {
        const std::vector<Side>* walls;
        double pillar, inner;
    } room{&walls, values["pillar_radius"], 0.5 * values["size"]};
    const auto fits = [](glm::dvec2 at, const void* context) {
        const Room& around = *static_cast<const Room*>(context);
        return std::all_of(around.walls->begin(), around.walls->end(), [&](const Side& side) {
            const glm::dvec2 to = at - side.middle();
            const double away = -(to.x * side.outward().x + to.y * side.outward().y);
            return away >= around.pillar + 0.5 * kWall + kPass;
        });
    };
    const double reach = room.inner;
    addPillars(layout,
               scatter(values.whole("pillars"), {-reach, -reach}, {reach, reach}, 2.0 * room.pillar + kPass,
                       values.whole("seed"), fits, &room),
               room.pillar);
    for (std::size_t i = 0; i < open.size(); ++i) {
        Json goals = Json::object();
        for (std::size_t other = 0; other < open.size(); ++other)
            if (other != i) goals[fmt::format("exit {}", other + 1)] = 1;
        layout["flows"].push_back({{"id", fmt::format("from exit {}", i + 1)},
                                   {"from", fmt::format("exit {}", i + 1)},
                                   {"to", {{"choose", goals}}},
                                   {"rate", values["rate"] / static_cast<double>(open.size())}});
    }
    return layout;
}

Json stadium(const GeneratorValues& values) {
    if (values.whole("stands") > 0) return stadiumOfStands(values);
    const std::uint64_t exits = values.whole("exits");
    const std::uint64_t sides =
        std::max<std::uint64_t>(exits, 12) / exits * exits;  // a multiple of the exits
    const double inner = values["radius"];
    const double outer = (inner + values["stand"]) /
                         std::cos(std::numbers::pi / static_cast<double>(std::max<std::uint64_t>(sides, 3)));
    Json layout = frameOf("stadium", values);
    layout["walls"].push_back(
        {{"id", "pitch"}, {"closed", true}, {"height", 1.0}, {"points", points(polygon(48, inner))}});
    const std::vector<Side> walls = ring(sides, outer, values["exit_width"]);
    Json gates = Json::array();
    for (std::size_t i = 0; i < walls.size(); ++i) {
        if (i % (sides / exits) == 0) {
            gates.push_back(fmt::format("exit {}", gates.size() + 1));
            walls[i].addTo(layout, gates.size());
        } else {
            layout["walls"].push_back({{"id", fmt::format("outer wall {}", i + 1)},
                                       {"thickness", kWall},
                                       {"points", points({walls[i].a, walls[i].b})}});
        }
    }
    // People sit in blocks all round, clear of both walls.
    constexpr std::uint64_t kBlocks = 12;
    constexpr double kMostDensity = 2.0;  // persons/m^2
    const double near = inner + 1.0;
    const double far = inner + values["stand"] - 1.0;
    const double ground = std::numbers::pi * (far * far - near * near);
    const auto people =
        std::min<std::uint64_t>(values.whole("people"), static_cast<std::uint64_t>(kMostDensity * ground));
    const double step = 2.0 * std::numbers::pi / static_cast<double>(kBlocks);
    for (std::uint64_t block = 0; block < kBlocks; ++block) {
        const double from = step * static_cast<double>(block);
        const std::string id = fmt::format("block {}", block + 1);
        layout["areas"].push_back({{"id", id}, {"polygon", points(sector(near, far, from, step, 6))}});
        const std::uint64_t count = shareOf(people, block, kBlocks);
        if (count == 0) continue;
        Json flow = {{"id", "from " + id}, {"from", id}};
        flow["to"] = nearestOf(gates);
        flow["count"] = count;
        flow["end"] = std::min(std::max(values["rise"], 0.05), values["duration"]);
        layout["flows"].push_back(flow);
    }
    return layout;
}

}  // namespace throng::authoring::generate
