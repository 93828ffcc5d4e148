// SPDX-License-Identifier: Apache-2.0
#include "sim/congestion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/vec4.hpp>

namespace throng::sim {
namespace {

constexpr std::uint32_t kStepsPerRound = 4;

// Cells of all fields that are brought up to date in a second: so many for each person, and in small scenes
// so many in all. Where there are more (a fair, where everybody has goals of their own), rounds take longer:
// what grows with the number of goals is not paid at every decision. News of a jam still gets on by some
// 2 m/s there, which is faster than jams do.
constexpr double kCellsOfEach = 24 * 128, kCellsOfAll = 24 * 128 * 1024;

/// How many times a round's fields have to be split.
/// @param seconds from one run to the next
std::uint32_t runsPerRound(std::uint32_t usual, std::uint64_t cells, std::uint64_t fields,
                           std::uint64_t people, double seconds) {
    const double at_once = seconds * std::max(kCellsOfEach * static_cast<double>(people), kCellsOfAll);
    const auto most = static_cast<std::uint64_t>(std::max(at_once / static_cast<double>(cells), 1.0));
    return std::max(usual, static_cast<std::uint32_t>((fields + most - 1) / most));
}

const gl::Declaration kFlow = {
    "routes",
    {"shaders/routes/detour_flow.comp"},
    {"ParametersBlock", "Ground", "Bodies", "StripStarts", "CellOffsets", "CrowdFlows", "ChartCells",
     "ChartShifts", "Belts", "LiftPlans", "LiftStops", "CabinStops"},
    {"CrowdFlows", "DenseBlocks"}};
const gl::Declaration kJamList = {"routes",
                                  {"shaders/routes/detour_list.comp"},
                                  {"ParametersBlock", "ChangedBlocks", "DenseBlocks", "BlockDispatch"},
                                  {"BlockDispatch", "ListedBlocks"}};
const gl::Declaration kJamRelax = {"routes",
                                   {"shaders/routes/detour_relax.comp"},
                                   {"ParametersBlock", "crowd_flows", "ground", "detour_distances",
                                    "free_distances", "ListedBlocks", "FieldMaps"},
                                   {"ChangedBlocks", "NextDistances"}};
const gl::Declaration kJamKeep = {"routes",
                                  {"shaders/routes/detour_keep.comp"},
                                  {"ParametersBlock", "ListedBlocks", "NextDistances"},
                                  {"DetourDistances"}};
const gl::Declaration kSlope = {
    "routes",
    {"shaders/routes/detour_slope.comp"},
    {"ParametersBlock", "free_distances", "ground", "detour_distances", "FieldMaps", "ListedBlocks"},
    {"DetourSlopes"}};

const gl::Declaration kShow = {"routes",
                               {"shaders/routes/detour_seams.comp"},
                               {"ParametersBlock", "ShownCells", "DetourDistances", "DetourSlopes"},
                               {"DetourDistances", "DetourSlopes", "ChangedBlocks"}};

const gl::Declaration kRide = {
    "routes",
    {"shaders/routes/detour_rides.comp"},
    {"ParametersBlock", "RideCells", "RideCosts", "LiftQueues", "FreeDistances", "DetourDistances"},
    {"DetourDistances", "ChangedBlocks"}};

}  // namespace

Congestion::Congestion(const gl::ShaderLibrary& library, Buffers& buffers, const authoring::Scene& scene,
                       const gpu::Parameters& parameters) {
    const authoring::Detours& detours = scene.detours;
    const MotionSettings& rules = scene.settings.motion;
    if (detours.distances.empty()) return;
    cells_ = parameters.detour_width * parameters.detour_height;
    fields_ = static_cast<std::uint32_t>(detours.ground_of_field.size());
    const auto steps_per_run = static_cast<std::uint32_t>(scene.settings.stepsPerDecision());
    runs_per_round_ = runsPerRound(std::max(kStepsPerRound / steps_per_run, 1u), cells_, fields_,
                                   parameters.row_count, double{parameters.decision_seconds});
    fields_per_run_ = (fields_ + runs_per_round_ - 1) / runs_per_round_;
    blocks_ = (cells_ + gpu::PIXEL_GROUP_SIZE - 1) / gpu::PIXEL_GROUP_SIZE;
    std::vector<gpu::FieldMap> maps;
    for (std::uint32_t field = 0; field < fields_; ++field)
        maps.push_back({detours.ground_of_field[field],
                        field < detours.has_choice.size() && detours.has_choice[field] ? 1u : 0u});
    field_maps_ = gl::makeBuffer("field maps", maps, "detour field");
    ground_ = gl::makeBuffer("ground", detours.ground, "cell of a ground");
    free_distances_ = gl::makeBuffer("free distances", detours.distances, "cell of a detour field");
    distances_ = gl::makeBuffer("detour distances", detours.distances, "cell of a detour field");
    next_distances_ = gl::Buffer(
        "next distances", {std::size_t{cells_} * fields_per_run_, sizeof(float), "cell of a detour field"});
    flows_ = gl::Buffer("crowd flows", {cells_, sizeof(gpu::CrowdFlow), "detour cell"});
    flows_.fill(0);
    dense_blocks_ = gl::Buffer("dense blocks", {blocks_, sizeof(std::uint32_t), "block of detour cells"});
    dense_blocks_.fill(0);
    const gl::Room marks{std::size_t{fields_} * blocks_, sizeof(std::uint32_t), "block of a detour field"};
    changed_before_ = gl::Buffer("blocks changed before", marks);
    changed_now_ = gl::Buffer("blocks changed now", marks);
    changed_before_.fill(1);  // nothing is known to have settled
    changed_now_.fill(0);
    listed_ = gl::Buffer("listed blocks", {std::size_t{fields_per_run_} * blocks_, sizeof(std::uint32_t),
                                           "block of a detour field"});
    no_blocks_ = gl::makeBuffer("no blocks", std::vector<std::uint32_t>{0, 1, 1});
    block_dispatch_ = gl::Buffer("block dispatch", no_blocks_.bytes());

    const std::vector<std::pair<std::string, const gl::Buffer*>> own = {{"Ground", &ground_},
                                                                        {"FreeDistances", &free_distances_},
                                                                        {"DetourDistances", &distances_},
                                                                        {"NextDistances", &next_distances_},
                                                                        {"CrowdFlows", &flows_},
                                                                        {"FieldMaps", &field_maps_},
                                                                        {"DenseBlocks", &dense_blocks_},
                                                                        {"ListedBlocks", &listed_},
                                                                        {"BlockDispatch", &block_dispatch_}};
    for (const auto& [program, declaration] :
         {std::pair{&flow_, &kFlow}, std::pair{&list_, &kJamList}, std::pair{&relax_, &kJamRelax},
          std::pair{&keep_, &kJamKeep}, std::pair{&slope_, &kSlope}}) {
        *program = buffers.connect(library, *declaration, buffers.definitions(rules));
        program->bindAll(own);
    }
    relax_.bind("ChangedBlocks", changed_now_);
    readCellsAsTexels();
    if (!detours.shown.empty()) showOverSeams(library, buffers, detours.shown);
    if (!detours.rides.empty()) takeLifts(library, buffers, detours.rides);
    const auto memory = static_cast<float>(rules.number("routes_round_jams", "memory"));
    costs_ = scene.patches.for_a_time;
    charged_.assign(costs_.size(), false);
    if (!costs_.empty()) free_ground_ = detours.ground;
    flow_.set("fading",
              1.0f - std::exp(-static_cast<float>(runs_per_round_) * parameters.decision_seconds / memory));
}

void Congestion::readCellsAsTexels() {
    using Texel = gl::WordTexture::Texel;
    ground_texels_ = gl::WordTexture(ground_, Texel::four_words);
    flow_texels_ = gl::WordTexture(flows_, Texel::four_words);
    free_texels_ = gl::WordTexture(free_distances_, Texel::one_word);
    distance_texels_ = gl::WordTexture(distances_, Texel::one_word);
    for (gl::ComputeProgram* program : {&relax_, &slope_}) {
        program->bind("ground", ground_texels_);
        program->bind("free_distances", free_texels_);
        program->bind("detour_distances", distance_texels_);
    }
    relax_.bind("crowd_flows", flow_texels_);
}

void Congestion::showOverSeams(const gl::ShaderLibrary& library, const Buffers& buffers,
                               const std::vector<glm::uvec2>& shown) {
    shown_count_ = static_cast<std::uint32_t>(shown.size());
    shown_cells_ = gl::makeBuffer("cells shown over seams", shown, "shown cell");
    show_distances_ = buffers.connect(library, kShow, {});
    show_slopes_ = buffers.connect(library, kShow, {{"SLOPES", "1"}});
    show_distances_.bind("DetourDistances", distances_);
    show_distances_.bind("ChangedBlocks", changed_now_);
    for (gl::ComputeProgram* program : {&show_distances_, &show_slopes_}) {
        program->bind("ShownCells", shown_cells_);
        program->set("shown_count", shown_count_);
    }
}

void Congestion::takeLifts(const gl::ShaderLibrary& library, const Buffers& buffers,
                           std::span<const authoring::Detours::Ride> rides) {
    std::vector<glm::uvec4> cells;
    std::vector<glm::vec2> costs;
    for (const authoring::Detours::Ride& ride : rides) {
        cells.emplace_back(ride.from, ride.to, ride.stop, 0u);
        costs.emplace_back(ride.cost, ride.cost_of_each);
    }
    ride_count_ = static_cast<std::uint32_t>(cells.size());
    ride_cells_ = gl::makeBuffer("rides of lifts", cells, "ride");
    ride_costs_ = gl::makeBuffer("what rides cost", costs, "ride");
    ride_ = buffers.connect(library, kRide, {});
    ride_.bind("RideCells", ride_cells_);
    ride_.bind("RideCosts", ride_costs_);
    ride_.bind("FreeDistances", free_distances_);
    ride_.bind("DetourDistances", distances_);
    ride_.bind("ChangedBlocks", changed_now_);
    ride_.set("ride_count", ride_count_);
}

void Congestion::show(gl::ComputeProgram& program, std::uint32_t count) {
    if (shown_count_ == 0) return;
    program.set("first_field", clock_.next_field);
    program.set("field_count", count);
    program.dispatch(std::uint64_t{shown_count_} * count);
}

void Congestion::chargeGround(double now) {
    std::vector<bool> holds;
    for (const authoring::Patches::Costs& costs : costs_)
        holds.push_back(now >= costs.from && now < costs.until);
    if (fields_ == 0 || holds == charged_) return;
    charged_ = holds;
    std::vector<gpu::GroundCell> ground = free_ground_;
    for (std::size_t i = 0; i < costs_.size(); ++i)
        for (const auto& [cell, cost] : costs_[i].cells)
            for (std::size_t at = cell; charged_[i] && at < ground.size(); at += cells_)
                ground[at].cost = std::min(ground[at].cost * cost, gpu::BLOCKED_COST);
    ground_.upload(ground);
    // Distances may change everywhere.
    changed_before_.fill(1);
    changed_now_.fill(1);
}

void Congestion::run() {
    if (fields_ == 0) return;
    if (clock_.runs++ % runs_per_round_ == 0) {
        dense_blocks_.fill(0);
        flow_.dispatch(cells_);
    }
    const std::uint32_t count = std::min(fields_per_run_, fields_ - clock_.next_field);
    list_.set("field_count", count);
    for (gl::ComputeProgram* program : {&list_, &relax_, &keep_})
        program->set("first_field", clock_.next_field);
    listBlocks(changed_before_, true);
    relax_.dispatchIndirect(block_dispatch_);
    keep_.dispatchIndirect(block_dispatch_);
    if (ride_count_ > 0) {
        ride_.set("first_field", clock_.next_field);
        ride_.set("field_count", count);
        ride_.dispatch(count);
    }
    show(show_distances_, count);
    listBlocks(changed_now_, false);
    slope_.dispatchIndirect(block_dispatch_);
    show(show_slopes_, count);
    clock_.next_field += count;
    if (clock_.next_field < fields_) return;
    clock_.next_field = 0;
    changed_before_.copyFrom(changed_now_);
    changed_now_.fill(0);
}

std::vector<std::pair<std::string, gl::Buffer*>> Congestion::remembered() {
    if (fields_ == 0) return {};
    return {{"detour distances", &distances_},
            {"crowd flows", &flows_},
            {"dense blocks", &dense_blocks_},
            {"blocks changed before", &changed_before_},
            {"blocks changed now", &changed_now_}};
}

void Congestion::listBlocks(const gl::Buffer& changed, bool dense_too) {
    block_dispatch_.copyFrom(no_blocks_);
    list_.bind("ChangedBlocks", changed);
    list_.set("dense_too", dense_too ? 1u : 0u);
    list_.dispatch(std::uint64_t{std::min(fields_per_run_, fields_ - clock_.next_field)} * blocks_);
}

}  // namespace throng::sim
