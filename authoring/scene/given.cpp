// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/given.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "authoring/scene/people.h"
#include "authoring/storeys/given_ways.h"

namespace throng::authoring {
namespace {

using Way = std::vector<GivenPoint>;

constexpr double kSlowest = 0.3, kFastest = 10.0;  // m/s: what a way may say of somebody's pace
constexpr double kMoves = 0.1;                     // m/s: slower is standing

/// How fast somebody walks while it does, and at most, m/s.
struct Pace {
    double mean = 0.0, most = 0.0;
};

Pace paceOf(const Way& way) {
    double length = 0.0, seconds = 0.0;
    Pace pace;
    for (std::size_t i = 1; i < way.size(); ++i) {
        const double piece = glm::distance(way[i].place, way[i - 1].place);
        const double time = way[i].time - way[i - 1].time;
        pace.most = std::max(pace.most, piece / time);
        if (piece < kMoves * time) continue;
        length += piece;
        seconds += time;
    }
    pace.mean = std::clamp(seconds > 0.0 ? length / seconds : 0.0, kSlowest, kFastest);
    pace.most = std::min(pace.most, kFastest);
    return pace;
}

glm::dvec2 placeAt(const Way& way, double time) {
    const auto after = std::ranges::upper_bound(way, time, {}, &GivenPoint::time);
    if (after == way.begin()) return way.front().place;
    if (after == way.end()) return way.back().place;
    const GivenPoint& before = *(after - 1);
    return glm::mix(before.place, after->place, (time - before.time) / (after->time - before.time));
}

/// Which way somebody faces at first: where it goes.
double headingOf(const Way& way) {
    for (const GivenPoint& point : way)
        if (const glm::dvec2 ahead = point.place - way.front().place; glm::length(ahead) > 1.0e-3)
            return std::atan2(ahead.y, ahead.x);
    return 0.0;
}

/// A way in home coordinates: the plane has each of its points on its own chart.
Way atHome(const Layout& layout, const Charts* charts, std::size_t group, std::size_t index) {
    Way way = layout.given[group].ways[index];
    for (std::size_t point = 0; charts && point < way.size(); ++point)
        way[point].place -= charts->charts[charts->given[group][index][point]].shift;
    return way;
}

/// m: from home to the plane, for somebody on its way at a time or, before that, at its begin.
/// @param way at home
glm::dvec2 shiftAt(const Charts* charts, std::size_t group, std::size_t index, const Way& way, double time) {
    if (!charts) return glm::dvec2(0.0);
    const auto after = std::ranges::upper_bound(way, time, {}, &GivenPoint::time);
    const std::size_t before = after == way.begin() ? 0 : static_cast<std::size_t>(after - way.begin()) - 1;
    const std::uint32_t chart = charts->given[group][index][before];
    return charts->charts[chartAfter(*charts, chart, way[before].place, placeAt(way, time)).value_or(chart)]
        .shift;
}

/// What a row needs and nobody goes by: where its way ends.
gpu::Stage lastStage(glm::vec2 place) {
    gpu::Stage stage{};
    stage.point = stage.facing = place;
    stage.field = stage.line = gpu::NO_INDEX;
    stage.activity = gpu::ACTIVITY_STAND;
    return stage;
}

}  // namespace

void tellOfFastWays(const Layout& layout, Diagnostics& diagnostics) {
    constexpr double kOnceInAWhile = 0.05;  // of a way's time: measured people leap now and then
    for (const GivenPeople& given : layout.given) {
        const auto fast = std::ranges::count_if(given.ways, [&](const Way& way) {
            double seconds = 0.0;
            for (std::size_t i = 1; i < way.size(); ++i)
                if (const double time = way[i].time - way[i - 1].time;
                    glm::distance(way[i].place, way[i - 1].place) > kFastest * time)
                    seconds += time;
            return seconds > kOnceInAWhile * (way.back().time - way.front().time);
        });
        if (fast > 0)
            diagnostics.warning(given.file.empty() ? given.where : given.file_where,
                                fmt::format("`{}`: {} of {} people are faster than {:g} m/s", given.id, fast,
                                            given.ways.size(), kFastest),
                                "ways are metres and seconds; files may need another `fps`");
    }
}

std::vector<gpu::Person> givenPeople(const Layout& layout, std::size_t index, const Charts* charts,
                                     const Rebase& rebase, std::uint32_t group) {
    const GivenPeople& given = layout.given[index];
    const GroupRandom random(layout.simulation.seed, given.id);
    const double begin = -layout.simulation.warmup;
    std::vector<gpu::Person> people;
    for (std::size_t i = 0; i < given.ways.size(); ++i) {
        const Way way = atHome(layout, charts, index, i);
        gpu::Person person = drawPerson(given.people, random, people.size(), group);
        const Pace pace = paceOf(way);
        person.maximum_speed *= static_cast<float>(pace.mean) / person.preferred_speed;
        person.maximum_speed = std::max(person.maximum_speed, static_cast<float>(pace.most));
        person.preferred_speed = static_cast<float>(pace.mean);
        person.spawn_position = rebase.local(placeAt(way, begin) + shiftAt(charts, index, i, way, begin));
        person.spawn_time = static_cast<float>(way.front().time);
        person.heading = static_cast<float>(headingOf(way));
        person.entry = gpu::NO_INDEX;
        person.flags |= gpu::PERSON_FIXED_SPAWN | gpu::PERSON_IS_GIVEN;
        if (way.front().time <= begin && way.back().time > begin)
            person.flags |= gpu::PERSON_PRESENT_AT_START;
        people.push_back(person);
    }
    return people;
}

void addWays(const Layout& layout, const Rebase& rebase, Scene& scene) {
    std::size_t count = 0;
    for (const GivenPeople& given : layout.given)
        count += given.ways.size();
    auto row = static_cast<std::uint32_t>(scene.people.size() - count);
    scene.given.first_row = row;
    const double begin = -layout.simulation.warmup;
    for (std::size_t group = 0; group < layout.given.size(); ++group) {
        const GivenPeople& given = layout.given[group];
        for (std::size_t i = 0; i < given.ways.size(); ++i) {
            const Way way = atHome(layout, scene.charts.get(), group, i);
            const glm::dvec2 shift = shiftAt(scene.charts.get(), group, i, way, begin);
            scene.given.ways.push_back({static_cast<gpu::uint>(scene.given.places.size()),
                                        static_cast<gpu::uint>(way.size()), glm::vec2(shift)});
            for (const GivenPoint& point : way)
                scene.given.places.push_back({rebase.local(point.place), static_cast<float>(point.time), 0});
            gpu::Person& person = scene.people[row++];
            person.first_stage = static_cast<gpu::uint>(scene.stages.size());
            person.stage_count = 1;
            scene.stages.push_back(lastStage(rebase.local(given.ways[i].back().place)));
            scene.goals.push_back(scene.stages.back().point);
        }
    }
}

}  // namespace throng::authoring
