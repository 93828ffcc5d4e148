// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "analysis/measure/head_watch.h"
#include "analysis/measure/measure.h"
#include "analysis/plot/line_plot.h"
#include "base/numbers.h"
#include "base/outcomes.h"

namespace throng::analysis {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kNeverMet = 1.0e6;  // m

Json spreadJson(const Spread& spread) {
    return {{"median", readable(spread.median)},
            {"p99", readable(spread.high)},
            {"worst", readable(spread.worst)}};
}

std::string spreadText(const Spread& spread) {
    return fmt::format("{:.3g} median, {:.3g} 99th percentile, {:.3g} worst", spread.median, spread.high,
                       spread.worst);
}

std::string looksText(const std::vector<double>& shares) {
    std::string text;
    for (std::size_t i = 0; i < shares.size(); ++i)
        text += fmt::format("{}{} {:.1f} %", i > 0 ? ", " : "", kLooksAt[i], shares[i]);
    return text;
}

double sumOf(const std::vector<VehicleCall>& calls, std::uint32_t VehicleCall::*what) {
    double sum = 0.0;
    for (const VehicleCall& call : calls)
        sum += call.*what;
    return sum;
}

Json callJson(const VehicleCall& call) {
    return {{"flow", call.flow},
            {"vehicle", call.vehicle},
            {"begin", readable(call.begin)},
            {"dwell", readable(call.dwell)},
            {"alighted", call.alighted},
            {"boarded", call.boarded},
            {"aboard", call.aboard}};
}

/// What an expectation may speak of.
std::optional<double> figureNamed(const Measurement& m, const std::string& name) {
    const auto share = [&](std::uint32_t count) {
        return m.agents ? static_cast<double>(count) / m.agents : 0.0;
    };
    const std::pair<std::string_view, double> figures[] = {
        {wordFor(Fate::arrived), share(m.arrived)},
        {wordFor(Fate::stuck), share(m.stuck)},
        {wordFor(Fate::seated), share(m.seated)},
        {wordFor(Fate::refused), share(m.refused)},
        {"seconds", m.seconds},
        {"overlapping_percent", m.overlapping_percent},
        {"deepest_overlap_percent", m.deepest_overlap_percent},
        {"wall_crossings", static_cast<double>(m.wall_crossings)},
        {"deepest_wall_penetration", m.deepest_wall_penetration},
        {"vehicle_clearance", m.vehicle_clearance.value_or(kNeverMet)},
        {"run_over", static_cast<double>(m.run_over)},
        {"alighted", sumOf(m.calls, &VehicleCall::alighted)},
        {"boarded", sumOf(m.calls, &VehicleCall::boarded)},
        {"time_ratio", m.time_ratio},
        {"detour_ratio", m.detour_ratio},
        {"heading_rate_p99", m.heading_rate.high},
        {"head_rate_p99", m.head_rate ? m.head_rate->high : 0.0},
        {"acceleration_p99", m.acceleration.high},
        {"backward_percent", m.backward_percent},
        {"effort", m.effort},
        {"lane_order", m.lane_order},
        {"mean_speed", m.mean_speed},
        {"high_density", m.high_density},
        {"flow", m.flow.value_or(0.0)},
    };
    for (const auto& [known, value] : figures)
        if (name == known) return value;
    return std::nullopt;
}

LinePlot plotOf(const std::string& title, const std::string& note, const std::string& x, const std::string& y,
                const std::vector<glm::dvec2>& points, bool markers) {
    LinePlot plot;
    plot.title = title;
    plot.note = note;
    plot.x = x;
    plot.y = y;
    plot.series.push_back({"", points, false, markers});
    return plot;
}

}  // namespace

Json measurementJson(const Measurement& m) {
    Json json = {{"agents", m.agents},
                 {keyFor(Fate::arrived), m.arrived},
                 {keyFor(Fate::walking), m.walking},
                 {keyFor(Fate::refused), m.refused},
                 {keyFor(Fate::stuck), m.stuck},
                 {"seconds", readable(m.seconds)},
                 {"duration", readable(m.duration)},
                 {"overlapping_percent", readable(m.overlapping_percent)},
                 {"worst_overlapping_percent", readable(m.worst_overlapping_percent)},
                 {"deepest_overlap_percent", readable(m.deepest_overlap_percent)},
                 {"wall_crossings", m.wall_crossings},
                 {"deepest_wall_penetration", readable(m.deepest_wall_penetration)},
                 {"time_ratio", readable(m.time_ratio)},
                 {"detour_ratio", readable(m.detour_ratio)},
                 {"heading_rate", spreadJson(m.heading_rate)},
                 {"acceleration", spreadJson(m.acceleration)},
                 {"jerk", spreadJson(m.jerk)},
                 {"backward_percent", readable(m.backward_percent)},
                 {"effort", readable(m.effort)},
                 {"lane_order", readable(m.lane_order)},
                 {"mean_density", readable(m.mean_density)},
                 {"high_density", readable(m.high_density)},
                 {"mean_speed", readable(m.mean_speed)}};
    if (m.seated > 0) json[keyFor(Fate::seated)] = m.seated;
    if (m.given)
        json["given"] = {{"people", m.given->people},
                         {"overlapping_percent", readable(m.given->overlapping_percent)},
                         {"deepest_overlap_percent", readable(m.given->deepest_overlap_percent)},
                         {"wall_crossings", m.given->wall_crossings},
                         {"deepest_wall_penetration", readable(m.given->deepest_wall_penetration)}};
    if (m.vehicles > 0) json["run_over"] = m.run_over;
    if (m.vehicle_clearance) json["vehicle_clearance"] = readable(*m.vehicle_clearance);
    if (m.head_rate) json["head_rate"] = spreadJson(*m.head_rate);
    for (std::size_t i = 0; i < m.looks_at.size(); ++i)
        json["looks_at"][std::string(kLooksAt[i])] = readable(m.looks_at[i]);
    if (m.flow) json["flow"] = readable(*m.flow);
    if (m.specific_flow) json["specific_flow"] = readable(*m.specific_flow);
    for (const VehicleCall& call : m.calls)
        json["calls"].push_back(callJson(call));
    for (const LinkFlow& link : m.links) {
        Json each = {{"id", link.id}, {"width", link.width}, {"forward", link.forward}, {"back", link.back}};
        if (link.flow) each["flow"] = readable(*link.flow);
        if (link.specific_flow) each["specific_flow"] = readable(*link.specific_flow);
        json["links"].push_back(std::move(each));
    }
    json["speed_by_density"] = Json::array();
    for (const glm::dvec2 point : m.speed_by_density)
        json["speed_by_density"].push_back({readable(point.x), readable(point.y)});
    return json;
}

std::string measurementText(const Measurement& m) {
    std::string text;
    const auto line = [&](const char* name, const std::string& value) {
        text += fmt::format("{:20} {}\n", name, value);
    };
    line("people", fmt::format("{}: {} {}, {} {} ({} of them {}), {} {}", m.agents, m.arrived,
                               wordFor(Fate::arrived), m.walking, wordFor(Fate::walking), m.stuck,
                               wordFor(Fate::stuck), m.refused, wordFor(Fate::refused)));
    if (m.seated > 0) line(wordFor(Fate::seated).data(), fmt::format("{} of those arrived", m.seated));
    line("time", fmt::format("{:.1f} s{} of {:.1f} s", m.seconds,
                             m.arrived == m.agents ? " until the last arrived," : "", m.duration));
    line("overlaps",
         fmt::format("{:.3f} % of people (mean; worst frame {:.2f} %), deepest {:.2f} % of the radii",
                     m.overlapping_percent, m.worst_overlapping_percent, m.deepest_overlap_percent));
    line("walls", fmt::format("{} crossings, deepest body in a wall {:.3f} m", m.wall_crossings,
                              m.deepest_wall_penetration));
    if (m.given)
        line("given people",
             fmt::format(
                 "{}: in others {:.3f} % of them (mean), deepest {:.2f} % of the radii; {} crossings of "
                 "walls, deepest {:.3f} m",
                 m.given->people, m.given->overlapping_percent, m.given->deepest_overlap_percent,
                 m.given->wall_crossings, m.given->deepest_wall_penetration));
    if (m.vehicles > 0)
        line("vehicles",
             fmt::format("{}: {} people run over, {}", m.vehicles, m.run_over,
                         m.vehicle_clearance ? fmt::format("least clearance {:.3f} m", *m.vehicle_clearance)
                                             : "nobody came near one"));
    for (const VehicleCall& call : m.calls)
        line("call",
             fmt::format("{} (vehicle {}) stood {:.1f} s from {:.1f} s on: {} got off, {} on, {} aboard",
                         call.flow, call.vehicle, call.dwell, call.begin, call.alighted, call.boarded,
                         call.aboard));
    line("to the goal", fmt::format("{:.2f} times the free time, {:.2f} times the shortest way (medians)",
                                    m.time_ratio, m.detour_ratio));
    line("heading rate, deg/s", spreadText(m.heading_rate));
    if (m.head_rate) line("head rate, deg/s", spreadText(*m.head_rate));
    if (!m.looks_at.empty()) line("people look at", looksText(m.looks_at));
    line("acceleration, m/s^2", spreadText(m.acceleration));
    line("jerk, m/s^3", spreadText(m.jerk));
    line("backward steps", fmt::format("{:.2f} % of walked frames", m.backward_percent));
    line("effort",
         fmt::format("{:.2f} J/(kg m) (median; 3.35 is walking alone at its best speed)", m.effort));
    line("lane order", fmt::format("{:.2f} (0 mixed, 1 pure lanes)", m.lane_order));
    line("density",
         fmt::format("{:.2f} persons/m^2 (mean), {:.2f} (99th percentile)", m.mean_density, m.high_density));
    line("speed", fmt::format("{:.2f} m/s (mean of all present)", m.mean_speed));
    if (m.specific_flow) line("flow over the line", fmt::format("{:.2f} persons/(s m)", *m.specific_flow));
    for (const LinkFlow& link : m.links)
        line("link",
             fmt::format(
                 "{}: {} forward, {} back{}", link.id, link.forward, link.back,
                 link.specific_flow ? fmt::format(", {:.2f} persons/(s m)", *link.specific_flow) : ""));
    return text;
}

void writeMeasurementPlots(const std::filesystem::path& folder, const Measurement& m,
                           const std::string& name) {
    writeLinePlot(folder / "arrivals.png",
                  plotOf("People arrived", name, "seconds", "people", m.arrivals, false));
    writeLinePlot(folder / "overlaps.png",
                  plotOf("Pairs that overlap by more than 1 %", name, "seconds", "pairs", m.overlaps, false));
    LinePlot speeds = plotOf("Speed by density", name + "; dashed: Weidmann 1993", "persons per square metre",
                             "metres per second", m.speed_by_density, true);
    speeds.series.front().name = "measured";
    PlotSeries weidmann{"Weidmann", {}, true, false};
    for (int i = 1; i <= 50; ++i) {
        const double density = 0.1 * i;
        weidmann.points.emplace_back(density, 1.34 * (1.0 - std::exp(-1.913 * (1.0 / density - 1.0 / 5.4))));
    }
    speeds.series.push_back(std::move(weidmann));
    writeLinePlot(folder / "speed_by_density.png", speeds);
}

std::vector<std::string> missedExpectations(const Measurement& m,
                                            const std::vector<authoring::Expectation>& expectations) {
    std::vector<std::string> missed;
    for (const authoring::Expectation& bar : expectations) {
        if (bar.figure == "head_rate_p99" && !m.head_rate) {
            missed.push_back("head_rate_p99 is not known: the bake has no stream `attention`");
            continue;
        }
        const double value = figureNamed(m, bar.figure).value();
        if (bar.minimum && value < *bar.minimum)
            missed.push_back(
                fmt::format("{} is {:.4g}, expected at least {:.4g}", bar.figure, value, *bar.minimum));
        if (bar.maximum && value > *bar.maximum)
            missed.push_back(
                fmt::format("{} is {:.4g}, expected at most {:.4g}", bar.figure, value, *bar.maximum));
    }
    return missed;
}

}  // namespace throng::analysis
