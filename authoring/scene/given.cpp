// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/given.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "authoring/scene/people.h"
#include "authoring/storeys/charts.h"

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

/// m: from home to where the people of a way begin in the plane.
glm::dvec2 shiftOf(const GivenPeople& given, const Scene& scene) {
    return scene.charts ? scene.charts->charts[given.level].shift : glm::dvec2(0.0);
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

bool isWithoutGivenPeople(const Layout& layout, Diagnostics& diagnostics) {
    for (const GivenPeople& given : layout.given)
        diagnostics.error(
            given.where, "layouts with levels on a terrain have no given people yet",
            "leave out the levels, or the given people; or give the levels floors, and leave out "
            "the terrain");
    return layout.given.empty();
}

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

std::vector<gpu::Person> givenPeople(const GivenPeople& given, const Layout& layout, const Rebase& rebase,
                                     std::uint32_t group) {
    const GroupRandom random(layout.simulation.seed, given.id);
    const double begin = -layout.simulation.warmup;
    std::vector<gpu::Person> people;
    for (const Way& way : given.ways) {
        gpu::Person person = drawPerson(given.people, random, people.size(), group);
        const Pace pace = paceOf(way);
        person.maximum_speed *= static_cast<float>(pace.mean) / person.preferred_speed;
        person.maximum_speed = std::max(person.maximum_speed, static_cast<float>(pace.most));
        person.preferred_speed = static_cast<float>(pace.mean);
        person.spawn_position = rebase.local(placeAt(way, begin));
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
    for (const GivenPeople& given : layout.given) {
        const glm::dvec2 shift = shiftOf(given, scene);
        for (const Way& way : given.ways) {
            scene.given.ways.push_back({static_cast<gpu::uint>(scene.given.places.size()),
                                        static_cast<gpu::uint>(way.size()), glm::vec2(shift)});
            for (const GivenPoint& point : way)
                scene.given.places.push_back(
                    {rebase.local(point.place - shift), static_cast<float>(point.time), 0});
            gpu::Person& person = scene.people[row++];
            person.first_stage = static_cast<gpu::uint>(scene.stages.size());
            person.stage_count = 1;
            scene.stages.push_back(lastStage(rebase.local(way.back().place)));
            scene.goals.push_back(scene.stages.back().point);
        }
    }
}

}  // namespace throng::authoring
