// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "authoring/scene.h"
#include "shaders/shared/simulation_types.h"
#include "sim/diagram/site_bins.h"
#include "sim/gl/buffer.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// What buffers by row and by slot have an element for.
inline constexpr const char* kPerson = "person";

/// Everything of a simulation that lives on the device. A buffer serves the storage block named beside it in
/// named().
struct Buffers {
    /// @throws GraphicsError when the device has no room
    Buffers(const authoring::Scene& scene, const gpu::Parameters& parameters);

    gl::Buffer parameters;

    gl::Buffer people, states;        // per row
    gl::Buffer chests;                // likewise
    gl::Buffer stages, plan_changes;  // routes
    gl::Buffer fields;                // may be larger than a storage block: read through field_cells
    gl::WordTexture field_cells;
    gl::Buffer road_distances;
    gl::Buffer lines, line_points, tickets;  // people who wait in line
    gl::Buffer behaviour_states, behaviour_rules, behaviour_places, behaviour_points;  // what people do
    gl::Buffer censuses, tallies, minds;
    gl::Buffer seat_ways, seat_points, sitters, sitter_of_row;         // seats that people walk to
    gl::Buffer detour_slopes;                                          // what jams add to them
    gl::Buffer queues, queue_heads, entries, entry_points, proposals;  // entering
    gl::Buffer wall_segments, wall_tiles, wall_starts, wall_items, narrow_cells;
    gl::Buffer chart_cells, chart_shifts, belts;
    gl::Buffer slot_images, row_slots;  // none without charts
    gl::Buffer lift_plans, lift_stops, cabin_stops, lift_states, lift_wishes, lift_queues, riders;
    // Signals and vehicles; of no use without traffic.
    gl::Buffer vehicles, vehicle_boxes, lanes, lane_points, traffic_stops;
    gl::Buffer crossings, crossing_points, lights, in_the_way;
    // Doors of vehicles; of no use without platforms.
    gl::Buffer vehicle_services, vehicle_doors, door_states, door_wishes, new_aboard, passengers;
    gl::Buffer platforms, platform_points, platform_vehicles, calls, call_heads;

    gl::Buffer cell_counts, cell_offsets;                                  // per cell
    gl::Buffer strip_counts, strip_marks, strip_starts, strip_group_sums;  // per strip of cells
    gl::Buffer strip_list, strip_list_end, fill_dispatch;
    gl::Buffer row_cells, live_dispatch;
    gl::Buffer site_slots;  // by ids of sites: also the order in which gradient1 draws
    gl::Buffer bodies, walkers, sites;
    // Until people have looked round, touch_slots holds rows on their way into cells (LooseRows).
    gl::Buffer neighbours, neighbour_counts, touch_words, touch_lists, touch_slots, touch_dispatch, weights;
    gl::Buffer near_lists;  // of bodies that are no discs
    gl::Buffer preferred_velocities, decisions, ways, targets, targets_after;

    /// A program with all of these buffers that it declares.
    gl::ComputeProgram connect(const gl::ShaderLibrary& library, const gl::Declaration& declaration,
                               const gl::Definitions& definitions = {}) const;
    std::vector<std::pair<std::string, const gl::Buffer*>> named() const;
    /// Whether anybody is no disc.
    bool hasBodies() const { return has_bodies_; }
    /// Whether the ground is cut into charts.
    bool hasCharts() const { return has_charts_; }
    /// Whether there are vehicles, or crossings at least.
    bool hasTraffic() const { return !traffic_.empty(); }
    /// What programs are compiled with that know of vehicles and of nothing else.
    gl::Definitions trafficDefinitions() const { return traffic_; }
    /// What programs are compiled with that know what people and ground there are.
    gl::Definitions definitions() const;
    /// What programs that move people are compiled with.
    gl::Definitions definitions(const MotionSettings& rules) const;
    /// Slots that per-slot lists are laid out for.
    std::uint32_t slotCapacity() const {
        return static_cast<std::uint32_t>(bodies.bytes() / sizeof(gpu::Body));
    }

  private:
    void makeLifts(const authoring::LiftMap& lifts, std::size_t people);
    void makeTraffic(const authoring::SceneTraffic& traffic);
    void makeBoarding(const authoring::SceneTraffic& traffic, std::size_t people);

    bool has_bodies_, has_charts_, has_belts_, has_seats_;
    gl::Definitions peculiarities_;
    gl::Definitions traffic_;  // how much of it there is
    gl::Definitions lifts_;    // likewise
};

/// Cells, windows and limits that follow from a scene.
/// @throws std::runtime_error for scenes too large, saying what would fit
gpu::Parameters makeParameters(const authoring::Scene& scene);

/// The wall tiles as sites of the diagram, with ids after all rows.
std::vector<gpu::DiagramSite> wallSites(const authoring::Scene& scene, const gpu::Parameters& parameters);

}  // namespace throng::sim
