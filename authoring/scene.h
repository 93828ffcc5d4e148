// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "authoring/layout.h"
#include "authoring/scene_traffic.h"
#include "authoring/terrain/terrain.h"
#include "base/activities.h"
#include "shaders/shared/behaviour_types.h"
#include "shaders/shared/chart_types.h"
#include "shaders/shared/lift_types.h"
#include "shaders/shared/scene_types.h"
#include "shaders/shared/seat_types.h"

namespace throng::authoring {

struct Charts;  // authoring/storeys/charts.h

/// The raster of the road distance, and on small sites of the distance fields. Cell (i, j) has its centre at
/// minimum + (i + 0.5, j + 0.5) * cell_size and the index j * width + i.
struct FieldGrid {
    glm::vec2 minimum{0.0f};  ///< m, scene frame
    float cell_size = 1.0f;   ///< m
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/// All distance fields, as the device holds them: a table of blocks, if there are any, and field after field.
struct FieldStore {
    std::vector<std::shared_ptr<const std::vector<gpu::FieldCell>>> fields;
    std::size_t cells_per_field = 0;
    float block_cell = 0.0f;          ///< m, the cells of fine blocks
    std::uint32_t blocks_across = 0;  ///< 0: the cells are those of the scene's grid
    std::uint32_t blocks_up = 0;
    /// Words: where each block's cells begin in a field, 0 where it has none; and another that says nothing.
    std::vector<gpu::FieldCell> block_table;
};

/// A wall opens or closes.
struct GateMove {
    double time = 0.0;  ///< s
    std::uint32_t wall = 0;
    bool opens = false;
};

/// Where a group of rows came from, for the account and the table of agents.
struct Group {
    std::string id;  ///< the flow's or formation's id
    bool is_flow = false;
    bool is_given = false;                   ///< its people follow given ways
    std::string look = {};                   ///< People::look
    std::vector<std::string> colours = {};   ///< People::colours
    std::vector<std::string> profiles = {};  ///< by gpu::Person::kind
    std::optional<std::size_t> block = {};   ///< of seats, in which its people sit from the beginning
};

/// What routes round jams are worked out on: a coarse map, and walking distances on it without any crowd.
/// Without cells where the layout does not ask for it.
struct Detours {
    FieldGrid grid;
    struct Ride {  ///< of a lift, from one cell to another
        std::uint32_t from, to;
        float cost;          ///< m on the flat that take as long
        float cost_of_each;  ///< m, for each who waits already
        std::uint32_t stop;  ///< where one gets in: index into LiftMap::stops
    };
    std::vector<gpu::GroundCell> ground;         ///< one map after the other
    std::vector<std::uint32_t> ground_of_field;  ///< which of the maps, per distance field
    std::vector<bool> has_choice;   ///< per field: whether it leads to the nearest of several places
    std::vector<float> distances;   ///< m, field after field; gpu::BLOCKED_COST where no path leads
    std::vector<glm::uvec2> shown;  ///< cells that show another chart's ground, and those that they show
    std::vector<Ride> rides;
};

/// Lifts, as the device has them.
struct LiftMap {
    std::vector<gpu::LiftPlan> plans;
    std::vector<gpu::LiftStop> stops;    ///< lift after lift
    std::vector<std::uint32_t> stop_of;  ///< by chart: index into stops; gpu::NO_INDEX: it is no cabin

    bool empty() const { return plans.empty(); }
};

/// The charts of a layout with levels as the device has them: a raster over the plane, and what takes people
/// from one chart to another.
struct ChartMap {
    FieldGrid grid;
    std::vector<gpu::ChartCell> cells;
    std::vector<glm::vec2> shifts;  ///< m, by chart: place in the plane - home
    std::vector<bool> is_link;      ///< by chart
    std::vector<float> costs;       ///< by chart: how many metres on the flat take as long as one of it
    std::vector<float> cell_costs;  ///< the same by cell; empty: each chart costs the same everywhere
    std::vector<gpu::Belt> belts;   ///< by chart; empty: no ground moves
    LiftMap lifts;
    std::uint32_t most_images = 0;  ///< of one person

    bool empty() const { return cells.empty(); }
    /// The cell around a place in the plane.
    const gpu::ChartCell& at(glm::vec2 place) const;
    /// The chart in whose part of the plane a place is; gpu::NO_CHART between them.
    std::uint32_t chartAt(glm::vec2 place) const { return at(place).charts & gpu::NO_CHART; }
    /// From the plane to home coordinates.
    glm::vec2 home(glm::vec2 place) const;
    float slopeCostAt(glm::vec2 place) const;
    /// Whether a place lies on the ground of a terrain, also beyond a seam; of floors nobody asks.
    bool isGround(glm::vec2 place) const;
    bool isBelt(std::uint32_t chart) const { return !belts.empty() && belts[chart].length > 0.0f; }
    /// Whether a cell that shows another chart's ground shows what one would have to go to against ground
    /// that moves: what is before its beginning, seen from it, or its end, seen from beyond.
    bool leadsAgainstBelt(glm::vec2 image) const;
};

/// Ground that people walk on at another pace or take another room on, as the device has it, and what some of
/// it costs for a time.
struct Patches {
    std::vector<gpu::Patch> slow;
    std::vector<gpu::Patch> sized;
    std::vector<glm::vec2> points;  ///< of their outlines
    struct Costs {
        double from = 0.0, until = 0.0;  ///< s
        /// Cells of the coarse map, and how many times what it costs otherwise a metre costs there.
        std::vector<std::pair<std::uint32_t, float>> cells;
    };
    std::vector<Costs> for_a_time;
};

/// People whose ways are given: the last rows.
struct GivenRows {
    std::uint32_t first_row = 0;
    std::vector<gpu::GivenWay> ways;  ///< per row from there on
    std::vector<gpu::GivenPlace> places;

    bool empty() const { return ways.empty(); }
};

/// Seats that people walk to or leave, as the device has them, and who they belong to. Those who share an
/// aisle come one behind the other.
struct SeatWays {
    std::vector<gpu::SeatWay> ways;
    std::vector<gpu::SeatPoint> points;
    std::vector<gpu::Sitter> sitters;          ///< as many as ways
    std::vector<std::uint32_t> sitter_of_row;  ///< gpu::NO_INDEX: it has no seat
    /// What each of them is to do in shows while it sits.
    std::vector<std::vector<SeatCue>> cues;

    bool empty() const { return ways.empty(); }
};

/// What people do, as the device has it. Without behaviours, empty.
struct Behaviours {
    std::vector<gpu::BehaviourState> states;
    std::vector<gpu::BehaviourRule> rules;
    std::vector<gpu::BehaviourPlace> places;
    std::vector<glm::vec2> points;  ///< spots, corners of outlines, and moments at which gates move (x)
    std::vector<gpu::Census> censuses;
    std::vector<gpu::Mind> minds;  ///< per row

    bool empty() const { return states.empty(); }
};

/// Everything the simulation needs, in the scene frame: single precision, metres from `origin`.
///
/// `origin` is a whole number of metres near the middle of the layout, and local coordinates are multiples of
/// 2^-16 m, so a layout moved by whole metres (a UTM offset, say) gives the very same scene.
struct Scene {
    SimulationSettings settings;
    glm::dvec2 origin{0.0};  ///< world = origin + scene
    glm::dvec2 output_origin{
        0.0};  ///< streams hold world - output_origin; zero for layouts near the world's origin
    glm::vec2 minimum{0.0f};  ///< bounds of all that people can reach, with a margin
    glm::vec2 maximum{0.0f};

    std::vector<gpu::Person> people;
    std::vector<glm::vec2> goals;  ///< per row, the middle of the last target, for the table of agents
    std::vector<gpu::Stage> stages;
    std::vector<gpu::PlanChange> plan_changes;
    std::vector<gpu::WaitingLine> lines;
    std::vector<glm::vec2> line_points;
    std::uint32_t ticket_count = 0;  ///< of all lines
    std::vector<gpu::Entry> entries;
    std::vector<glm::vec2> entry_points;
    std::vector<gpu::SpawnQueue> queues;
    std::vector<Group> groups;
    Behaviours behaviours;
    SeatWays seats;
    GivenRows given;

    std::vector<gpu::WallSegment> wall_segments;
    std::vector<std::uint32_t> hiding_walls;  ///< indices of those segments that nobody looks over
    std::vector<glm::vec2> narrow_places;     ///< m: middles of narrow passages, if people take turns there
    std::vector<gpu::WallTile> wall_tiles;
    std::vector<GateMove> gate_moves;          ///< in the order of their times
    std::vector<std::uint32_t> open_at_start;  ///< walls
    SceneTraffic traffic;

    FieldGrid grid;
    FieldStore fields;
    std::uint32_t field_count = 0;
    Detours detours;
    Patches patches;
    std::vector<float> road_distance;  ///< m, per grid cell: positive on roads and areas, negative off them;
                                       ///< empty without roads

    std::shared_ptr<const Terrain> terrain;  ///< null: the ground is flat; with charts, in the plane

    std::shared_ptr<const Charts> charts;  ///< null: a layout without levels; then everything is in the plane
    ChartMap chart_map;

    float smallest_radius = 0.0f;  ///< of all people, m; of bodies that are no discs, half of the longer side
    float largest_radius = 0.0f;
};

}  // namespace throng::authoring
