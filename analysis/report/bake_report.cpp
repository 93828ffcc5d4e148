// SPDX-License-Identifier: Apache-2.0
#include "analysis/report/bake_report.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/report/crowd_json.h"
#include "analysis/report/packed_ways.h"
#include "analysis/report/page.h"
#include "analysis/stuck.h"
#include "base/plane_grid.h"
#include "base/storeys.h"

namespace throng::analysis {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double value, double step) {
    return std::round(value / step) * step;
}

/// What is plotted over time, second by second, and who got in whose way.
class Watch {
  public:
    Watch(const io::Bake& bake, const std::vector<io::AgentRow>& rows, double most_size)
        : bake_(bake),
          rows_(rows),
          per_second_(static_cast<std::uint32_t>(std::max(1.0, std::round(bake.fps)))),
          grid_(bake.minimum, bake.maximum, 1.0, cellsFor(rows.size())) {
        for (const io::AgentRow& row : rows)
            largest_radius_ = std::max(largest_radius_, most_size * row.reach());
    }

    void look(const io::CrowdFrame& frame) {
        const std::uint32_t for_overlaps = std::max(1u, per_second_ / 6);
        const bool whole_second = frame.index() % per_second_ == 0 || frame.index() + 1 == bake_.frames;
        if (!whole_second && frame.index() % for_overlaps != 0) return;
        gatherPresent(frame);
        if (whole_second) tally(frame);
        findOverlaps(frame.index());
    }

    Json series = {{"time", Json::array()}, {"present", Json::array()}, {"speed", Json::array()}};

    /// The deepest pairs, each in its worst moment.
    Json overlaps() const {
        constexpr std::size_t kMost = 200;
        std::vector<std::pair<double, std::pair<std::uint64_t, std::uint32_t>>> worst;
        worst.reserve(overlaps_.size());
        for (const auto& [pair, found] : overlaps_)
            worst.push_back({found.first, {pair, found.second}});
        std::sort(worst.begin(), worst.end(), [](const auto& a, const auto& b) {
            return a.first != b.first ? a.first > b.first : a.second < b.second;
        });
        Json list = Json::array();
        for (std::size_t i = 0; i < std::min(kMost, worst.size()); ++i)
            list.push_back({{"a", worst[i].second.first >> 32},
                            {"b", worst[i].second.first & 0xffffffffu},
                            {"frame", worst[i].second.second},
                            {"percent", rounded(100.0 * worst[i].first, 0.1)}});
        return list;
    }
    std::size_t overlapCount() const { return overlaps_.size(); }

  private:
    void gatherPresent(const io::CrowdFrame& frame) {
        present_.clear();
        bodies_.clear();
        shapes_.clear();
        heights_.clear();
        for (std::uint32_t row = 0; row < frame.rows(); ++row) {
            if (!frame.isThere(row)) continue;
            present_.push_back(row);
            bodies_.push_back(frame.place(row));
            shapes_.push_back(frame.body(row, rows_[row]));
            heights_.push_back(bake_.hasStoreys() ? frame.height(row) : 0.0);
        }
    }

    void tally(const io::CrowdFrame& frame) {
        double speeds = 0.0;
        for (const std::uint32_t row : present_)
            speeds += frame.speed(row);
        series["time"].push_back(rounded(frame.index() / bake_.fps, 0.001));
        series["present"].push_back(present_.size());
        series["speed"].push_back(
            present_.empty() ? Json() : Json(rounded(speeds / static_cast<double>(present_.size()), 0.001)));
    }

    void findOverlaps(std::uint32_t frame) {
        constexpr double kCounts = 0.01;  // of the sum of radii, as `throng measure` has it
        grid_.sort(bodies_);
        for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
            const std::uint32_t row = present_[i];
            const double reach = shapes_[i].thickness + glm::length(shapes_[i].axis);
            grid_.near(bodies_[i], reach + largest_radius_, [&](std::uint32_t j) {
                const glm::dvec2 offset = bodies_[j] - bodies_[i];
                const double most = reach + largest_radius_;
                if (j <= i || glm::dot(offset, offset) > most * most ||
                    !areOnOneGround(heights_[i], heights_[j]))
                    return;
                const std::uint32_t other = present_[j];
                const double depth = overlapOf(shapes_[i], shapes_[j]);
                if (depth <= kCounts) return;
                auto& found = overlaps_[std::uint64_t{row} << 32 | other];
                if (depth > found.first) found = {depth, frame};
            });
        }
    }

    const io::Bake& bake_;
    const std::vector<io::AgentRow>& rows_;
    std::uint32_t per_second_;
    std::vector<std::uint32_t> present_;
    std::vector<glm::dvec2> bodies_;  // of those present
    std::vector<Capsule> shapes_;
    std::vector<double> heights_;  // m
    PlaneGrid grid_;
    double largest_radius_ = 0.0;
    std::map<std::uint64_t, std::pair<double, std::uint32_t>> overlaps_;
};

/// Who is stuck at the end, and since when: all that time within half a metre of where they are.
Json stuckOnes(io::CrowdReader& crowd, const StuckWatch& stuck) {
    const io::Bake& bake = crowd.bake();
    Json list = Json::array();
    std::vector<std::uint32_t> still;
    for (std::uint32_t row = 0; row < crowd.rows(); ++row)
        if (stuck.isStuck(row)) still.push_back(row);
    if (still.empty()) return list;
    const io::CrowdFrame end = crowd.frame(bake.frames - 1);
    const auto step = static_cast<std::uint32_t>(std::max(1.0, std::round(bake.fps / 4.0)));
    for (std::uint32_t since = *stuck.firstFrame(); !still.empty();) {
        const std::uint32_t earlier = since - std::min(since, step);
        const io::CrowdFrame then = crowd.frame(earlier);
        std::erase_if(still, [&](std::uint32_t row) {
            const bool was_there = since > 0 && isUnderWay(then, row) &&
                                   glm::distance(then.place(row), end.place(row)) < kStuckMetres;
            if (!was_there) list.push_back({{"agent", row}, {"frame", since}});
            return !was_there;
        });
        since = earlier;
    }
    return list;
}

Json measuredJson(const Measurement& measured) {
    Json json = measurementJson(measured);
    const auto curve = [](const std::vector<glm::dvec2>& points) {
        Json list = Json::array();
        for (const glm::dvec2 point : points)
            list.push_back({rounded(point.x, 0.001), rounded(point.y, 0.0001)});
        return list;
    };
    json["speed_by_density"] = curve(measured.speed_by_density);
    json["arrivals"] = curve(measured.arrivals);
    json["overlaps"] = curve(measured.overlaps);
    return json;
}

/// Everybody, column by column.
Json agentsJson(const std::vector<io::AgentRow>& rows, const io::GroupTable& groups, const PackedWays& ways) {
    Json agents = {{"group", Json::array()},   {"radius", Json::array()}, {"outcome", Json::array()},
                   {"arrival", Json::array()}, {"first", Json::array()},  {"last", Json::array()}};
    for (std::size_t row = 0; row < rows.size(); ++row) {
        agents["group"].push_back(groups.group_of[row]);
        agents["radius"].push_back(rounded(rows[row].radius, 0.001));
        agents["outcome"].push_back(rows[row].outcome == "arrived"   ? 1
                                    : rows[row].outcome == "walking" ? 0
                                                                     : 2);
        agents["arrival"].push_back(rows[row].arrival_frame == 0xffffffffu ? Json()
                                                                           : Json(rows[row].arrival_frame));
        const bool never = ways.first[row] > ways.last[row];
        agents["first"].push_back(never ? Json() : Json(ways.first[row]));
        agents["last"].push_back(never ? Json() : Json(ways.last[row]));
    }
    return agents;
}

}  // namespace

FramesOfReport framesOfReport(io::CrowdReader& crowd) {
    WayPacker packer(crowd.bake());
    Watch watch(crowd.bake(), crowd.people(), crowd.mostSize());
    StuckWatch stuck(crowd);
    for (std::uint32_t frame = 0; frame < crowd.frames(); ++frame) {
        const io::CrowdFrame now = crowd.frame(frame);
        packer.add(now);
        watch.look(now);
        stuck.look(now);
    }
    return {packer.finish(), watch.series, watch.overlaps(), watch.overlapCount(), stuckOnes(crowd, stuck)};
}

std::string bakeReport(io::CrowdReader& crowd, const FramesOfReport& frames, const Measurement& measured,
                       const std::vector<std::string>& missed) {
    const io::Bake& bake = crowd.bake();
    const PackedWays& ways = frames.ways;
    const io::GroupTable groups = io::groupsOf(crowd.people());
    Json data = crowdJson(bake, groups);
    data["complete"] = bake.complete;
    data["seed"] = bake.seed;
    data["agents"] = agentsJson(crowd.people(), groups, ways);
    data["measured"] = measuredJson(measured);
    data["missed"] = missed;
    data["refused"] = bake.manifest.contains("/account/refused_reasons"_json_pointer)
                          ? bake.manifest.at("/account/refused_reasons"_json_pointer)
                          : Json::object();
    data["device"] = bake.manifest.value("device", Json::object());
    data["generator"] = bake.manifest.value("generator", "");
    data["series"] = frames.series;
    data["overlaps"] = frames.overlaps;
    data["overlap_pairs"] = frames.overlap_pairs;
    data["stuck"] = frames.stuck;
    data["ways"] = {{"every", ways.every},
                    {"moments", ways.moments},
                    {"quantum", ways.quantum},
                    {"largest_error", rounded(ways.largest_error, 0.0001)},
                    {"usual_error", rounded(ways.usual_error, 0.0001)},
                    {"deflated", base64(ways.deflated)}};
    if (!ways.deflated_storeys.empty()) data["ways"]["storeys"] = base64(ways.deflated_storeys);
    if (!ways.deflated_sizes.empty()) data["ways"]["sizes"] = base64(ways.deflated_sizes);
    return makePage("bake", bake.name, data);
}

nlohmann::ordered_json thumbnailOf(io::CrowdReader& crowd) {
    constexpr std::uint32_t kPeople = 60, kPoints = 14;
    const io::Bake& bake = crowd.bake();
    const glm::dvec2 extent = bake.maximum - bake.minimum;
    const double scale = 255.0 / std::max({extent.x, extent.y, 1.0});
    const auto put = [&](Json& list, double x, double y) {
        list.push_back(static_cast<int>(std::clamp((x - bake.minimum.x) * scale, 0.0, 255.0)));
        list.push_back(static_cast<int>(std::clamp((y - bake.minimum.y) * scale, 0.0, 255.0)));
    };
    Json thumbnail = {{"size", {std::lround(extent.x * scale), std::lround(extent.y * scale)}},
                      {"walls", Json::array()},
                      {"ways", Json::array()}};
    for (const authoring::Wall& wall : bake.walls) {
        Json outline = Json::array({wall.closed ? 1 : 0});
        for (const glm::dvec2 point : wall.points)
            put(outline, point.x, point.y);
        thumbnail["walls"].push_back(outline);
    }
    const std::uint32_t step = std::max(1u, bake.agents / kPeople);
    const io::GroupTable groups = io::groupsOf(crowd.people());
    std::vector<Json> ways;
    for (std::uint32_t row = 0; row < bake.agents; row += step)
        ways.push_back(Json::array({groups.group_of[row]}));
    for (std::uint32_t point = 0; point < kPoints && bake.frames > 0; ++point) {
        const io::CrowdFrame frame =
            crowd.frame(static_cast<std::uint32_t>(std::uint64_t{point} * (bake.frames - 1) / (kPoints - 1)));
        for (std::size_t way = 0; way < ways.size(); ++way)
            put(ways[way], frame.place(way * step).x, frame.place(way * step).y);
    }
    for (Json& way : ways)
        thumbnail["ways"].push_back(std::move(way));
    return thumbnail;
}

}  // namespace throng::analysis
