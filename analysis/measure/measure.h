// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/measure/call_watch.h"
#include "io/crowd_reader.h"

namespace throng::analysis {

struct MeasureOptions {
    /// A line across which people are counted, m in world coordinates.
    std::optional<std::pair<glm::dvec2, glm::dvec2>> line;
};

/// The median, the 99th percentile and the largest of a quantity.
struct Spread {
    double median = 0.0, high = 0.0, worst = 0.0;
};

/// Who went over a link of a layout with levels: counted at its middle.
struct LinkFlow {
    std::string id;
    double width = 0.0;                        ///< m
    std::uint64_t forward = 0, back = 0;       ///< persons, from where it begins and from where it ends
    std::optional<double> flow = {};           ///< persons/s, while anybody crosses
    std::optional<double> specific_flow = {};  ///< persons/(s m)
};

/// People whose ways are given: what they are in is no doing of the crowd's.
struct GivenFigures {
    std::uint32_t people = 0;
    double overlapping_percent = 0.0;  ///< pairs of theirs deeper than 1 %, per given person present
    double deepest_overlap_percent = 0.0;
    std::uint64_t wall_crossings = 0;
    double deepest_wall_penetration = 0.0;  ///< m
};

/// How well a crowd moves, from the written files alone (docs/measure.md). Metres, seconds, degrees.
struct Measurement {
    std::uint32_t agents = 0, arrived = 0, walking = 0, refused = 0;  ///< but for given people
    std::uint32_t seated = 0;  ///< at the end; figures of motion, density and overlaps are of the others
    std::uint32_t stuck = 0;   ///< StuckWatch
    double seconds = 0.0;      ///< until the last arrival; the bake's length where somebody has not arrived
    double duration = 0.0;     ///< of the bake

    double overlapping_percent = 0.0;        ///< pairs deeper than 1 %, per person present, mean over frames
    double worst_overlapping_percent = 0.0;  ///< likewise in the worst frame
    double deepest_overlap_percent = 0.0;    ///< of the sum of the radii
    std::uint64_t wall_crossings = 0;
    double deepest_wall_penetration = 0.0;  ///< m that a body is inside a wall
    std::size_t vehicles = 0;
    std::vector<VehicleCall> calls;           ///< of vehicles at platforms
    std::optional<double> vehicle_clearance;  ///< m, between a body and a vehicle; none: they never met
    std::uint32_t run_over = 0;               ///< people whom a vehicle was in

    double time_ratio = 0.0;    ///< time to the goal over the shortest way at the preferred speed, median
    double detour_ratio = 0.0;  ///< way walked over the shortest way, median of those who arrived
    Spread heading_rate;        ///< deg/s, while walking
    std::optional<Spread> head_rate;  ///< deg/s, of heads on chests; none: the bake does not tell it
    std::vector<double> looks_at;     ///< percent of the time, by LooksAt; none: likewise
    Spread acceleration;              ///< m/s^2
    Spread jerk;                      ///< m/s^3
    double backward_percent = 0.0;    ///< of the walked frames, moving against the own heading
    double effort = 0.0;              ///< J/(kg m): sum of (2.23 + 1.26 v^2) dt over the way (Whittle 2007)
    double lane_order = 0.0;          ///< Rex and Loewen 2007: 0 mixed, 1 all lanes pure; mean over seconds

    double mean_density = 0.0, high_density = 0.0;  ///< persons/m^2, Voronoi; mean and 99th percentile
    double mean_speed = 0.0;                        ///< m/s, of those present
    std::optional<double> flow;                     ///< persons/s across the line, while anybody crosses
    std::optional<double> specific_flow;            ///< persons/(s m) across the line, while anybody crosses

    std::optional<GivenFigures> given;  ///< none where nobody's way is; all other figures of single people
                                        ///< and of what they are in are of the others
    std::vector<LinkFlow> links;        ///< none where there are no levels

    std::vector<glm::dvec2> speed_by_density;  ///< (persons/m^2, mean m/s)
    std::vector<glm::dvec2> arrivals;          ///< (s, people arrived)
    std::vector<glm::dvec2> overlaps;          ///< (s, pairs deeper than 1 %)
};

/// Throws InputError when the bake's files are not what they should be.
Measurement measureBake(io::CrowdReader& crowd, const MeasureOptions& options);

nlohmann::ordered_json measurementJson(const Measurement& m);
std::string measurementText(const Measurement& m);
/// arrivals.png, overlaps.png and speed_by_density.png. Throws OutputError.
void writeMeasurementPlots(const std::filesystem::path& folder, const Measurement& m,
                           const std::string& name);

/// The bars that were missed, in words; empty when all hold.
std::vector<std::string> missedExpectations(const Measurement& m,
                                            const std::vector<authoring::Expectation>& expectations);

}  // namespace throng::analysis
