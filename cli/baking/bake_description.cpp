// SPDX-License-Identifier: Apache-2.0
#include "cli/baking/bake_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <tuple>

#include "authoring/layout/amounts.h"
#include "authoring/layout/layout_reader.h"
#include "authoring/layout/row_floor.h"
#include "authoring/layout/seat_mouths.h"
#include "authoring/scene/audience.h"
#include "authoring/scene/terrain_check.h"
#include "authoring/storeys/charts.h"
#include "base/files/errors.h"
#include "base/files/hash.h"
#include "base/text/printable.h"
#include "recording/gaits.h"

namespace throng::cli {
namespace {

constexpr double kFigureBesideThings = 0.25;  // m: half the shoulder breadth of who is with a thing

/// Who begins in a seat may be where no chart is (authoring/storeys/plane.cpp).
glm::dvec2 goalOf(const authoring::Scene& scene, std::size_t row) {
    if (scene.people[row].flags & gpu::PERSON_SITS_AT_START) {
        const gpu::SeatWay& way = scene.seats.ways[scene.seats.sitter_of_row[row]];
        return scene.origin + glm::dvec2(way.place - way.shift);
    }
    return scene.origin + glm::dvec2(scene.chart_map.home(scene.goals[row]));
}

std::vector<recording::BakeAgent> describeAgents(const authoring::Scene& scene) {
    std::vector<recording::BakeAgent> agents;
    agents.reserve(scene.people.size());
    for (std::size_t row = 0; row < scene.people.size(); ++row) {
        const gpu::Person& person = scene.people[row];
        agents.push_back({person.group, person.radius, person.preferred_speed, person.variation,
                          person.party_first, goalOf(scene, row)});
        if (person.half_axis != 0.0f) {
            const double thickness = double{person.radius} - std::abs(double{person.half_axis});
            const double longer = 2.0 * double{person.radius};
            agents.back().body = person.half_axis > 0.0f ? BodySize{longer, 2.0 * thickness}
                                                         : BodySize{2.0 * thickness, longer};
            // Whoever is with a wheelchair or a suitcase is no larger for it.
            if (person.half_axis < 0.0f)
                agents.back().radius = static_cast<float>(std::min(thickness, kFigureBesideThings));
        }
        agents.back().profile = scene.groups[person.group].profiles[person.kind];
    }
    return agents;
}

bool isShown(const authoring::SeatBlock& block) {
    return block.isOpen() || authoring::hasPassages(block);
}

recording::BakeAisle describeAisle(const authoring::SeatBlock& block, std::size_t aisle) {
    if (!authoring::hasPassages(block)) {
        recording::BakeAisle described{authoring::aisleLine(block, aisle), authoring::aisleWidth(block)};
        if (block.ground) described.heights = authoring::aisleHeights(block, aisle);
        return described;
    }
    const authoring::Flight passage = authoring::passageOf(block, aisle);
    recording::BakeAisle described{passage.line, passage.width};
    described.passage = {passage.line, passage.heights, passage.width};
    for (const authoring::Flight& flight : authoring::flightsOf(block, aisle))
        described.flights.push_back({flight.line, flight.heights, flight.width});
    return described;
}

/// Those who have seats come after all who are simulated.
void describeAudience(const authoring::Layout& layout, const authoring::Scene& scene,
                      recording::BakeDescription& bake) {
    const std::size_t first_group = bake.groups.size(), first_row = bake.agents.size();
    for (const authoring::SeatBlock& block : layout.seats) {
        bake.groups.push_back({block.id, false, false, block.people.look,
                               fmt::format("{}", fmt::join(block.people.colours, " "))});
        bake.seats.push_back({block.id, block.pitch, block.width, block.rise, {}});
        for (const authoring::SeatRow& row : authoring::seatRows(block))
            bake.seats.back().rows.push_back({row.line, row.height, row.heights});
        bake.seats.back().ground = authoring::lowestGround(block);
        for (std::size_t aisle = 0; isShown(block) && aisle < authoring::countAisles(block); ++aisle)
            bake.seats.back().aisles.push_back(describeAisle(block, aisle));
    }
    for (authoring::Spectator& each : authoring::audienceOf(layout)) {
        const authoring::SeatBlock& block = layout.seats[each.block];
        recording::BakeAgent agent;
        agent.group = static_cast<std::uint32_t>(first_group + each.block);
        agent.radius = each.person.radius;
        agent.preferred_speed = each.person.preferred_speed;
        agent.variation = each.person.variation;
        agent.party = static_cast<std::uint32_t>(first_row) + each.party;
        agent.goal = each.seat.place;
        agent.profile = block.people.kinds[each.person.kind].profile;
        bake.agents.push_back(std::move(agent));
        bake.audience.push_back({glm::vec2(each.seat.place - scene.origin), glm::vec2(each.seat.ahead),
                                 static_cast<float>(each.seat.height), each.person.variation,
                                 std::move(each.deeds)});
        bake.variations = std::max(bake.variations, each.person.variation + 1);
    }
}

/// A crowd that cheers is heard all over the place.
recording::EyeCatcher cheering(const authoring::Show& show, const authoring::SeatBlock& block) {
    constexpr double kCarries = 100.0;  // m
    const double depth = 0.5 * static_cast<double>(block.rows);
    glm::dvec2 middle(0.0);
    for (const glm::dvec2 point : block.front)
        middle += point / static_cast<double>(block.front.size());
    const double ground = block.on_terrain && block.ground ? block.ground(middle) : 0.0;
    const double height = block.height + depth * block.rise + (std::isnan(ground) ? 0.0 : ground);
    const double begin = authoring::meanOf(show.at);
    return {middle, height, 1.0, kCarries, begin, begin + authoring::meanOf(show.lasts), true, true};
}

/// What draws eyes, by the layout's order; then audiences that cheer.
void describeEyeCatchers(const LoadedLayout& loaded, recording::BakeDescription& bake) {
    const authoring::Layout& layout = loaded.layout;
    constexpr double kNever = 1.0e9;  // s
    const authoring::TerrainGrounds* cut = loaded.scene.charts ? loaded.scene.charts->grounds.get() : nullptr;
    const auto heightOf = [&](const authoring::Attraction& each) {
        return cut->attraction_heights[static_cast<std::size_t>(&each - layout.attractions.data())];
    };
    for (const authoring::Attraction& each : layout.attractions) {
        const glm::dvec2 place = each.at - loaded.scene.origin;
        const double ground = cut                      ? heightOf(each)
                              : !layout.levels.empty() ? layout.levels[each.level].height
                              : loaded.scene.terrain
                                  ? double{loaded.scene.terrain->smoothAt(glm::vec2(place))}
                                  : 0.0;
        bake.eye_catchers.push_back({place, ground + each.height, each.weight, each.reach, each.from,
                                     each.until.value_or(each.loud ? each.from : kNever), each.loud});
        // Floors are level; terrain that is cut is not.
        if (!cut && !layout.levels.empty()) bake.eye_catchers.back().storey = ground;
    }
    for (const authoring::Show& show : layout.shows) {
        if (show.kind != authoring::Show::Kind::cheer || show.share == 0.0) continue;
        for (const std::size_t block : show.blocks) {
            bake.eye_catchers.push_back(cheering(show, layout.seats[block]));
            bake.eye_catchers.back().place -= loaded.scene.origin;
        }
    }
}

void describeVehicles(const authoring::Scene& scene, recording::BakeDescription& bake) {
    for (std::size_t i = 0; i < scene.traffic.vehicles.size(); ++i) {
        const auto& type = authoring::kVehicleTypes.at(scene.traffic.vehicles[i].kind);
        bake.vehicles.push_back({scene.traffic.flows[scene.traffic.flow_of[i]], type.name, type.length,
                                 type.width, type.height, type.wheel});
    }
}

/// Of each vehicle, where people get on and off anything at all.
void describeDoors(const authoring::Layout& layout, const authoring::Scene& scene,
                   recording::BakeDescription& bake) {
    if (!scene.traffic.hasDoors()) return;
    for (const std::uint32_t line : scene.traffic.flow_of) {
        const authoring::VehicleFlow& flow = layout.traffic.vehicles.at(line);
        DoorIdentity doors;
        if (flow.doors) {
            doors = {flow.doors->at, flow.doors->width,
                     flow.doors->sides != authoring::VehicleDoors::Sides::right,
                     flow.doors->sides != authoring::VehicleDoors::Sides::left, flow.capacity};
        }
        bake.doors.push_back(std::move(doors));
    }
}

void describeCabins(const LoadedLayout& loaded, recording::BakeDescription& bake) {
    const authoring::LiftMap& lifts = loaded.scene.chart_map.lifts;
    if (lifts.empty()) return;
    for (const std::uint32_t stop : lifts.stop_of)
        bake.charts->cabins.push_back(
            stop == gpu::NO_INDEX
                ? recording::BakeCharts::Cabin{}
                : recording::BakeCharts::Cabin{lifts.stops[stop].lift, lifts.stops[stop].height});
    for (std::size_t i = 0; i < bake.lifts.size(); ++i)
        bake.lifts[i].lift.capacity = lifts.plans.at(i).capacity;
}

void addLinks(const std::vector<authoring::Link>& links, recording::BakeDescription& bake) {
    for (const authoring::Link& link : links)
        (link.isLift() ? bake.lifts : bake.links).push_back(link);
}

/// Of a terrain that is cut: it is the ground as it is, and has names.
void describeGrounds(const LoadedLayout& loaded, recording::BakeDescription& bake) {
    const authoring::Charts& charts = *loaded.scene.charts;
    bake.levels = charts.grounds->levels;
    bake.roads = charts.grounds->home.roads;
    bake.areas = charts.grounds->home.areas;
    bake.patches = charts.grounds->home.patches;
    for (const gpu::Vehicle& vehicle : loaded.scene.traffic.vehicles) {
        constexpr double kWithin = 0.1;  // m
        const authoring::Chart& chart = charts.charts[charts.plane.traffic.lanes[vehicle.lane].level];
        const auto [lower, upper] = chart.bounds();
        const glm::dvec2 move = chart.shift - loaded.scene.origin;
        bake.vehicle_grounds.push_back({chart.shift, lower + move + kWithin, upper + move - kWithin});
    }
    addLinks(charts.plane.links, bake);
    describeCabins(loaded, bake);
    bake.terrain = recording::BakeTerrain{charts.grounds->seen ? charts.grounds->seen : loaded.terrain,
                                          loaded.scene.terrain,
                                          loaded.layout.terrain->file,
                                          loaded.terrain_hash,
                                          charts.ground_along_walls,
                                          true};
}

/// Of a layout with levels: its floors and links are the ground, and end in railings.
void describeCharts(const LoadedLayout& loaded, recording::BakeDescription& bake) {
    constexpr double kMargin = 3.0;  // m
    const authoring::Scene& scene = loaded.scene;
    const authoring::Charts& charts = *scene.charts;
    bake.charts.emplace();
    std::tie(bake.minimum, bake.maximum) = charts.charts.front().bounds();
    for (const authoring::Chart& chart : charts.charts) {
        bake.charts->shifts.push_back(chart.shift);
        const auto [lower, upper] = chart.bounds();
        bake.minimum = glm::min(bake.minimum, lower - kMargin);
        bake.maximum = glm::max(bake.maximum, upper + kMargin);
    }
    for (const gpu::Belt& belt : scene.chart_map.belts)
        bake.charts->belts.emplace_back(belt.velocity);
    bake.walls = charts.walls;
    if (charts.grounds) {
        describeGrounds(loaded, bake);
        return;
    }
    bake.levels = loaded.layout.levels;
    addLinks(loaded.layout.links, bake);
    describeCabins(loaded, bake);
    bake.terrain =
        recording::BakeTerrain{std::shared_ptr<const authoring::TerrainMesh>(scene.charts, &charts.home_mesh),
                               scene.terrain, "levels", hashText(loaded.text), charts.ground_along_walls};
}

}  // namespace

std::string outputOf(const LoadedLayout& loaded, const BakeOptions& options) {
    if (!options.output.empty()) return options.output;
    if (isFileName(loaded.layout.name)) return loaded.layout.name;
    throw InputError(loaded.diagnostics.file,
                     fmt::format("its `name`, `{}`, is no name for a folder: change it, or give one with -o",
                                 printable(loaded.layout.name)));
}

std::uint32_t framesOf(const authoring::SimulationSettings& settings) {
    return static_cast<std::uint32_t>(std::max(1l, std::lround(settings.duration * settings.fps)));
}

recording::BakeDescription describeBake(const LoadedLayout& loaded, const BakeOptions& options,
                                        const gl::Device& device) {
    const authoring::Scene& scene = loaded.scene;
    recording::BakeDescription bake;
    bake.output = outputOf(loaded, options);
    bake.force = options.force;
    bake.name = loaded.layout.name;
    bake.layout_text = authoring::layoutWith(loaded.text, loaded.overrides);
    bake.source = {loaded.file, hashText(loaded.text), loaded.overrides};
    bake.seed = scene.settings.seed;
    bake.fps = scene.settings.fps;
    bake.frames = framesOf(scene.settings);
    bake.ends_when_empty = scene.settings.ends_when_empty;
    bake.substeps = static_cast<std::uint32_t>(scene.settings.substeps);
    bake.duration = scene.settings.duration;
    bake.warmup = scene.settings.warmup;
    bake.smoothing = scene.settings.smoothing;
    for (const gpu::Person& person : scene.people)
        bake.variations = std::max(bake.variations, person.variation + 1);
    bake.strides = recording::allStrides();
    bake.scene_origin = scene.origin;
    bake.output_origin = scene.output_origin;
    bake.minimum = scene.origin + glm::dvec2(scene.minimum);
    bake.maximum = scene.origin + glm::dvec2(scene.maximum);
    for (const authoring::Group& group : scene.groups)
        bake.groups.push_back({group.id, group.is_flow, group.is_given, group.look,
                               fmt::format("{}", fmt::join(group.colours, " "))});
    bake.agents = describeAgents(scene);
    describeAudience(loaded.layout, scene, bake);
    for (std::size_t i = 0; i < scene.seats.cues.size(); ++i)
        if (!scene.seats.cues[i].empty())
            bake.sitters.push_back({scene.seats.ways[i].row, scene.seats.cues[i]});
    bake.has_poses = std::ranges::any_of(scene.behaviours.states, [](const gpu::BehaviourState& state) {
        return state.activity >= gpu::ACTIVITY_SIT;
    });
    bake.roads = loaded.layout.roads;
    bake.areas = loaded.layout.areas;
    bake.patches = loaded.layout.patches;
    bake.walls = loaded.layout.walls;
    bake.traffic = loaded.layout.traffic;
    describeVehicles(scene, bake);
    describeDoors(loaded.layout, scene, bake);
    if (scene.charts) describeCharts(loaded, bake);
    if (loaded.terrain && !scene.charts) {
        const authoring::Rebase rebase(loaded.layout);
        bake.terrain = recording::BakeTerrain{
            loaded.terrain, scene.terrain, loaded.layout.terrain->file, loaded.terrain_hash, {}};
        for (const authoring::Wall& wall : loaded.layout.walls)
            bake.terrain->along_walls.push_back(authoring::groundAlong(wall, rebase, *scene.terrain));
    }
    describeEyeCatchers(loaded, bake);
    bake.renderer = device.name;
    bake.driver = device.version;
    bake.gltf = options.gltf;
    bake.gltf_agents = options.gltf_agents;
    bake.formats = options.formats;
    return bake;
}

void askForBodies(recording::BakeDescription& bake) {
    for (const recording::BakeAgent& agent : bake.agents)
        bake.asked[Stream::chest] = bake.asked[Stream::chest] || !agent.body.isDisc();
    for (const authoring::Patch& patch : bake.patches)
        bake.asked[Stream::size] = bake.asked[Stream::size] || patch.size != 1.0;
}

std::map<std::string, std::uint32_t> refusals(const Account& account) {
    std::map<std::string, std::uint32_t> reasons;
    for (const AgentOutcome& agent : account.agents)
        if (agent.status == AgentStatus::refused) ++reasons[agent.reason];
    return reasons;
}

}  // namespace throng::cli
