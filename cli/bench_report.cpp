// SPDX-License-Identifier: Apache-2.0
#include "cli/bench_report.h"

#include <fmt/format.h>

#include <array>

#include "base/files/output_file.h"

namespace throng::cli {
namespace {

/// Table 1 of De Gyves, Toledo and Rudomin 2013: ms per diagram of 1,024 x 1,024 on a GeForce GT 540M.
struct PaperRow {
    const char* method;
    std::array<double, 5> milliseconds;  // 2^8, 2^12, 2^14, 2^16, 2^20 sites
};
constexpr double kNotGiven = 0.0;
constexpr std::array kPaperSites = {256u, 4096u, 16384u, 65536u, 1048576u};
constexpr std::array kPaper = {PaperRow{"cones", {0.50, 2.82, 4.90, 11.62, 125.0}},
                               PaperRow{"gradient1", {0.32, 1.97, 7.04, 26.31, 250.0}},
                               PaperRow{"gradient2", {0.75, 6.75, 25.0, 100.0, 500.0}},
                               PaperRow{"per-pixel", {62.5, 500.0, kNotGiven, kNotGiven, kNotGiven}},
                               PaperRow{"per-site", {2.85, 10.2, 29.4, 100.0, 500.0}},
                               PaperRow{"jfa", {29.4, 29.4, 29.4, 29.4, 29.4}}};

std::string grouped(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(static_cast<std::size_t>(at), ",");
    return digits;
}

std::string milliseconds(double value) {
    return value >= 100.0  ? fmt::format("{:.0f}", value)
           : value >= 10.0 ? fmt::format("{:.1f}", value)
                           : fmt::format("{:.2f}", value);
}

std::string share(double value) {
    if (value == 0.0) return "0";
    return value < 1.0e-4 ? fmt::format("{:.4f} %", 100.0 * value) : fmt::format("{:.2f} %", 100.0 * value);
}

std::string head(const BenchMachine& machine) {
    return fmt::format("{} ({}), {} processor cores. Times by {}.\n", machine.device.name,
                       machine.device.version, machine.cores, machine.timer);
}

std::string caseName(const sim::DiagramCase& setup) {
    return fmt::format("{} r {:g}", grouped(setup.sites), setup.radius);
}

template <class Cell>
std::string table(const std::string& first, const std::vector<std::string>& columns,
                  const std::vector<std::string>& rows, Cell&& cell) {
    std::string text = "| " + first + " |";
    std::string rule = "|---|";
    for (const std::string& column : columns) {
        text += " " + column + " |";
        rule += "---|";
    }
    text += "\n" + rule + "\n";
    for (std::size_t row = 0; row < rows.size(); ++row) {
        text += "| " + rows[row] + " |";
        for (std::size_t column = 0; column < columns.size(); ++column)
            text += " " + cell(row, column) + " |";
        text += "\n";
    }
    return text;
}

std::string diagramMarkdown(const DiagramReport& report) {
    std::vector<std::string> columns, methods;
    for (const sim::DiagramCase& setup : report.cases)
        columns.push_back(caseName(setup));
    for (const sim::DiagramContestant& contestant : report.contestants)
        methods.push_back(contestant.name);
    const auto cellOf = [&](auto&& text) {
        return [&report, text](std::size_t row, std::size_t column) -> std::string {
            const auto& timing = report.timings[column][row];
            return timing ? text(*timing) : "-";
        };
    };
    std::string text =
        "# Building the diagram: every method, one machine, one run\n\n" + head(report.machine);
    text +=
        "Made by `throng bench diagrams`. Sites thrown at random over 1,024 x 1,024 px; r is the tile radius "
        "in px. All methods\n"
        "of a column ran in turn, round by round. A dash: left out, because it would have taken minutes.\n\n"
        "## Milliseconds: median (10th to 90th percentile)\n\n";
    text += table("method", columns, methods, cellOf([](const sim::DiagramTiming& timing) {
                      return fmt::format("{} ({}-{})", milliseconds(timing.median_ms),
                                         milliseconds(timing.low_ms), milliseconds(timing.high_ms));
                  }));
    text += fmt::format("\n`auto` took: ");
    for (std::size_t i = 0; i < report.cases.size(); ++i)
        text += fmt::format("{}{} at {}", i ? "; " : "", report.automatic[i], caseName(report.cases[i]));
    text += fmt::format(".\n\n## Ratio to \"{}\", median over the rounds\n\n",
                        report.contestants[report.yardstick].name);
    text +=
        table("method", columns, methods,
              cellOf([](const sim::DiagramTiming& timing) { return fmt::format("{:.2f}", timing.ratio); }));
    text += "\n## Pixels with a wrong owner, against comparing all sites on the CPU\n\n";
    text += table("method", columns, methods,
                  cellOf([](const sim::DiagramTiming& timing) { return share(timing.wrong_share); }));
    text +=
        "\n## The paper's own figures\n\nDe Gyves, Toledo and Rudomin 2013, Table 1, ms per diagram of 1,024 "
        "x 1,024 px on a "
        "GeForce GT 540M.\n\n";
    std::vector<std::string> paper_columns, paper_rows;
    for (const std::uint32_t sites : kPaperSites)
        paper_columns.push_back(grouped(sites));
    for (const PaperRow& row : kPaper)
        paper_rows.emplace_back(row.method);
    text += table("method", paper_columns, paper_rows, [](std::size_t row, std::size_t column) {
        const double value = kPaper[row].milliseconds[column];
        return value == kNotGiven ? std::string("-") : fmt::format("{:g}", value);
    });
    return text;
}

std::string diagramCsv(const DiagramReport& report) {
    std::string text =
        "source,method,sites,radius_px,side_px,median_ms,p10_ms,p90_ms,ratio,wrong_share,rounds\n";
    for (std::size_t i = 0; i < report.cases.size(); ++i)
        for (std::size_t j = 0; j < report.contestants.size(); ++j) {
            if (!report.timings[i][j]) continue;
            const sim::DiagramCase& setup = report.cases[i];
            const sim::DiagramTiming& timing = *report.timings[i][j];
            text += fmt::format("measured,\"{}\",{},{:g},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.8f},{}\n",
                                report.contestants[j].name, setup.sites, setup.radius, setup.side,
                                timing.median_ms, timing.low_ms, timing.high_ms, timing.ratio,
                                timing.wrong_share, timing.rounds);
        }
    for (const PaperRow& row : kPaper)
        for (std::size_t i = 0; i < kPaperSites.size(); ++i)
            if (row.milliseconds[i] != kNotGiven)
                text += fmt::format("paper,{},{},,1024,{:g},,,,,\n", row.method, kPaperSites[i],
                                    row.milliseconds[i]);
    return text;
}

struct ProximityWay {
    const char* name;
    std::optional<sim::ProximityTiming> sim::ProximityRow::*timing;
};
constexpr std::array kWays = {ProximityWay{"voronoi", &sim::ProximityRow::voronoi},
                              ProximityWay{"grid", &sim::ProximityRow::grid},
                              ProximityWay{"brute", &sim::ProximityRow::brute}};

std::string proximityMarkdown(const ProximityReport& report) {
    std::vector<std::string> columns, ways;
    for (const sim::ProximityRow& row : report.rows)
        columns.push_back(grouped(row.people));
    for (const ProximityWay& way : kWays)
        ways.emplace_back(way.name);
    const auto cellOf = [&](auto&& text) {
        return [&report, text](std::size_t way, std::size_t column) -> std::string {
            const auto& timing = report.rows[column].*kWays[way].timing;
            return timing ? text(*timing) : "-";
        };
    };
    const sim::ProximityBenchmark& s = report.settings;
    std::string text =
        "# Finding neighbours: the diagram against a grid and against everybody\n\n" + head(report.machine);
    text += fmt::format(
        "Made by `throng bench proximity`. One person per {:g} m^2, body radius {:g} m, tile radius {:g} m, "
        "field of view {:g}\n"
        "degrees, {} samples a ray, {} neighbours; the same crowd for all, in turn, round by round.\n"
        "`voronoi` marches rays through the truncated diagram, `grid` looks through the cells around a "
        "person (as Bleiweiss\n"
        "2009), `brute` compares all with all. Sorting people into cells, which all need for contact, is not "
        "counted.\n\n"
        "## Finding neighbours, ms a step (median)\n\n",
        s.spacing * s.spacing, s.body_radius, s.tile_radius, s.field_of_view, s.samples_per_ray,
        s.neighbours);
    text += table("way", columns, ways,
                  cellOf([](const sim::ProximityTiming& timing) { return milliseconds(timing.search_ms); }));
    text += "\n## The whole step, ms (median)\n\n";
    text += table("way", columns, ways,
                  cellOf([](const sim::ProximityTiming& timing) { return milliseconds(timing.step_ms); }));
    text += "\n## Recall of the nearest neighbours\n\n";
    text += table("way", columns, ways, cellOf([](const sim::ProximityTiming& timing) {
                      return fmt::format("{:.3f} %", 100.0 * timing.recall);
                  }));
    return text;
}

std::string proximityCsv(const ProximityReport& report) {
    std::string text = "way,people,search_ms,step_ms,recall,rounds\n";
    for (const sim::ProximityRow& row : report.rows)
        for (const ProximityWay& way : kWays)
            if (const auto& timing = row.*way.timing)
                text += fmt::format("{},{},{:.4f},{:.4f},{:.6f},{}\n", way.name, row.people,
                                    timing->search_ms, timing->step_ms, timing->recall, timing->rounds);
    return text;
}

}  // namespace

void writeDiagramReport(const std::filesystem::path& folder, const DiagramReport& report) {
    replaceFile(folder / "diagrams.md", diagramMarkdown(report));
    replaceFile(folder / "diagrams.csv", diagramCsv(report));
}

void writeProximityReport(const std::filesystem::path& folder, const ProximityReport& report) {
    replaceFile(folder / "proximity.md", proximityMarkdown(report));
    replaceFile(folder / "proximity.csv", proximityCsv(report));
}

}  // namespace throng::cli
