// SPDX-License-Identifier: Apache-2.0
#include "analysis/compare/compare.h"

#include <fmt/format.h>

#include <array>
#include <glm/common.hpp>

#include "analysis/plot/line_plot.h"
#include "base/files/errors.h"
#include "base/numbers.h"

namespace throng::analysis {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kEdge = 1.0;  // m: whose neighbours there are not known

struct Quantity {
    const char* key;
    const char* name;
    const char* unit;
    Distribution Observed::*member;
    bool needs_line = false;
};
const std::array kQuantities = {
    Quantity{"speed", "Speed", "m/s", &Observed::speed},
    Quantity{"acceleration", "Acceleration", "m/s^2", &Observed::acceleration},
    Quantity{"turning", "Turning", "deg/s", &Observed::turning},
    Quantity{"sway", "Sway aside", "m", &Observed::sway},
    Quantity{"density", "Density", "persons/m^2", &Observed::density},
    Quantity{"neighbour", "Nearest neighbour", "m", &Observed::neighbour},
    Quantity{"wall", "Nearest wall", "m", &Observed::wall},
    Quantity{"time_gap", "Time gap", "s", &Observed::time_gap, true},
};

double secondsOf(const Trajectories& looks) {
    std::int64_t first = looks.tracks.front().first, last = first;
    for (const Track& track : looks.tracks) {
        first = std::min(first, track.first);
        last = std::max(last, track.first + static_cast<std::int64_t>(track.places.size()) - 1);
    }
    return static_cast<double>(last - first) / kLooks;
}

/// A metre inside of where people were seen, where there is more than that.
Box2d areaAround(const Trajectories& people) {
    const Box2d box = boundsOf(people);
    const glm::dvec2 edge = glm::min(glm::dvec2(kEdge), 0.25 * (box.maximum - box.minimum));
    return {box.minimum + edge, box.maximum - edge};
}

bool anybodyIsIn(const Box2d& area, const Trajectories& people) {
    for (const Track& track : people.tracks)
        for (const glm::dvec2 place : track.places)
            if (area.holds(place)) return true;
    return false;
}

std::string boxText(const Box2d& box) {
    return fmt::format("{:.2f} {:.2f} to {:.2f} {:.2f}", box.minimum.x, box.minimum.y, box.maximum.x,
                       box.maximum.y);
}

void mustBeIn(const Box2d& area, const Trajectories& crowd, const std::filesystem::path& path) {
    if (anybodyIsIn(area, crowd)) return;
    throw InputError(
        path, fmt::format("nobody is ever in the area that is compared ({} m); they are in {} m. "
                          "--move and --turn put trajectories where the bake's people are, --area says "
                          "where to look",
                          boxText(area), boxText(boundsOf(crowd))));
}

std::string valuesText(const Distribution& values) {
    if (values.count() == 0) return "-";
    return fmt::format("{:.3g} ({:.3g} to {:.3g})", values.quantile(0.5), values.quantile(0.1),
                       values.quantile(0.9));
}

Json valuesJson(const Distribution& values) {
    Json json = {{"samples", values.count()}};
    if (values.count() == 0) return json;
    json["mean"] = readable(values.mean());
    json["median"] = readable(values.quantile(0.5));
    json["p10"] = readable(values.quantile(0.1));
    json["p90"] = readable(values.quantile(0.9));
    return json;
}

Json sideJson(const Side& side) {
    Json json = {{"name", side.name}, {"people", side.people}, {"seconds", readable(side.seconds)}};
    if (side.seen.flow) json["flow"] = readable(*side.seen.flow);
    json["speed_by_density"] = Json::array();
    for (const glm::dvec2 point : side.seen.speed_by_density)
        json["speed_by_density"].push_back({readable(point.x), readable(point.y)});
    return json;
}

LinePlot plotOf(const Comparison& comparison, const std::string& title, const std::string& x,
                const std::string& y, std::vector<glm::dvec2> bake, std::vector<glm::dvec2> people,
                bool markers) {
    LinePlot plot;
    plot.title = title;
    plot.note = comparison.bake.name + " beside " + comparison.people.name;
    plot.x = x;
    plot.y = y;
    plot.series.push_back({"bake", std::move(bake), false, markers});
    plot.series.push_back({"trajectories", std::move(people), true, markers});
    return plot;
}

}  // namespace

Comparison compareWith(io::CrowdReader& crowd, const Trajectories& people, const CompareOptions& options) {
    const Trajectories baked = trajectoriesOf(crowd, kLooks), seen = resampled(people, kLooks);
    if (baked.tracks.empty())
        throw InputError(crowd.bake().folder, "nobody is ever there: there is nothing to compare");
    if (seen.tracks.empty()) throw InputError(people.name, "nobody is there for a tenth of a second");
    Comparison comparison;
    comparison.has_line = options.line.has_value();
    comparison.area = options.area.value_or(areaAround(seen));
    mustBeIn(comparison.area, baked, crowd.bake().folder);
    mustBeIn(comparison.area, seen, people.name);
    const ObserveOptions observing{comparison.area, options.line};
    recording::WallWatch walls(crowd.bake().walls, crowd.bake().minimum, crowd.bake().maximum);
    const auto sideOf = [&](const Trajectories& looks) {
        return Side{looks.name, looks.people, secondsOf(looks),
                    observe(looks, observing, walls, crowd.bake().origin)};
    };
    comparison.bake = sideOf(baked);
    comparison.people = sideOf(seen);
    return comparison;
}

Json comparisonJson(const Comparison& comparison) {
    const Box2d& area = comparison.area;
    Json json = {{"area",
                  {readable(area.minimum.x), readable(area.minimum.y), readable(area.maximum.x),
                   readable(area.maximum.y)}},
                 {"bake", sideJson(comparison.bake)},
                 {"trajectories", sideJson(comparison.people)},
                 {"figures", Json::object()}};
    for (const Quantity& quantity : kQuantities) {
        if (quantity.needs_line && !comparison.has_line) continue;
        const Distribution& a = comparison.bake.seen.*quantity.member;
        const Distribution& b = comparison.people.seen.*quantity.member;
        Json figure = {{"unit", quantity.unit}, {"bake", valuesJson(a)}, {"trajectories", valuesJson(b)}};
        if (a.count() && b.count()) {
            figure["wasserstein"] = readable(meanDistance(a, b));
            figure["kolmogorov_smirnov"] = readable(largestDifference(a, b));
        }
        json["figures"][quantity.key] = std::move(figure);
    }
    return json;
}

std::string comparisonText(const Comparison& comparison) {
    const Side &bake = comparison.bake, &people = comparison.people;
    std::string text = fmt::format("in the area {} m, ten looks a second\n\n", boxText(comparison.area));
    const auto line = [&](const std::string& name, const std::string& a, const std::string& b,
                          const std::string& mean, const std::string& most) {
        text += fmt::format("{:26} {:28} {:28} {:>8} {:>6}\n", name, a, b, mean, most);
    };
    line("", "bake", "trajectories", "apart", "K-S");
    line("people", fmt::format("{}", bake.people), fmt::format("{}", people.people), "", "");
    line("seconds", fmt::format("{:.1f}", bake.seconds), fmt::format("{:.1f}", people.seconds), "", "");
    if (comparison.has_line) {
        const auto flow = [](const Side& side) {
            return side.seen.flow ? fmt::format("{:.3g}", *side.seen.flow) : std::string("-");
        };
        line("flow, persons/s", flow(bake), flow(people), "", "");
    }
    for (const Quantity& quantity : kQuantities) {
        if (quantity.needs_line && !comparison.has_line) continue;
        const Distribution& a = bake.seen.*quantity.member;
        const Distribution& b = people.seen.*quantity.member;
        const bool both = a.count() && b.count();
        line(fmt::format("{}, {}", quantity.name, quantity.unit), valuesText(a), valuesText(b),
             both ? fmt::format("{:.3g}", meanDistance(a, b)) : "-",
             both ? fmt::format("{:.2f}", largestDifference(a, b)) : "-");
    }
    return text +
           "\nmedian (10 to 90 %); apart: Wasserstein's distance of the distributions, in the unit;\n"
           "K-S: the largest difference of shares, 0 (alike) to 1\n";
}

void writeComparisonPlots(const std::filesystem::path& folder, const Comparison& comparison) {
    const Observed &bake = comparison.bake.seen, &people = comparison.people.seen;
    for (const Quantity& quantity : kQuantities) {
        if (quantity.needs_line && !comparison.has_line) continue;
        writeLinePlot(folder / (std::string(quantity.key) + ".png"),
                      plotOf(comparison, quantity.name, fmt::format("{}, {}", quantity.name, quantity.unit),
                             "share of the samples up to this", (bake.*quantity.member).shares(),
                             (people.*quantity.member).shares(), false));
    }
    writeLinePlot(folder / "speed_by_density.png",
                  plotOf(comparison, "Speed by density", "persons per square metre", "metres per second",
                         bake.speed_by_density, people.speed_by_density, true));
    if (comparison.has_line)
        writeLinePlot(folder / "passed.png",
                      plotOf(comparison, "People across the line", "seconds since the first", "people",
                             bake.passed, people.passed, false));
}

}  // namespace throng::analysis
