// SPDX-License-Identifier: Apache-2.0
#include "sim/memory.h"

#include <algorithm>

#include "sim/buffers.h"
#include "sim/diagram/sparse_layers.h"
#include "sim/frame_pump.h"
#include "sim/gl/buffer.h"
#include "sim/simulation_parts.h"

namespace throng::sim {
namespace {

bool isOfPeople(const gl::BufferCount::Counted& buffer) {
    return buffer.per == "person" || buffer.per == kSite;
}

/// Whether as many as come in over time make the level of detail build per site, which keeps distances, and
/// walls in two layers.
bool mayBuildPerSite(const authoring::Scene& scene, const gpu::Parameters& parameters,
                     const DiagramOptions& options) {
    const DiagramMethod method = scene.settings.method;
    if (method != DiagramMethod::automatic) return method == DiagramMethod::per_site;
    const CostModel costs = CostModel::builtIn();
    DiagramLoad load = diagramLoad(scene, parameters);
    const auto present = std::ranges::count_if(scene.people, [](const gpu::Person& person) {
        return (person.flags & gpu::PERSON_PRESENT_AT_START) != 0;
    });
    DiagramPlan plan;
    for (load.sites = std::max<double>(static_cast<double>(present), 1.0); load.sites <= parameters.row_count;
         load.sites *= 2.0) {
        plan = costs.plan(load, double{options.look}, plan);
        if (plan.cost->method == DiagramMethod::per_site) return true;
    }
    return false;
}

/// The owners, and what the way to find them keeps beside; a store of pages where they are not kept whole.
std::size_t bytesOfDiagram(const authoring::Scene& scene, const gpu::Parameters& parameters,
                           const Buffers& buffers) {
    const DiagramOptions options = diagramOptions(scene, parameters, buffers);
    const std::size_t whole = std::size_t{options.width} * options.height * gl::kWord;
    const std::size_t squares = std::size_t{pagesAcross(options.width)} * pagesAcross(options.height);
    const std::vector<gpu::DiagramSite> walls = wallSites(scene, parameters);
    std::size_t pages_of_walls = 1, of_walls = 0;
    if (!walls.empty()) {
        const FixedSquares found(options.width, options.height, walls);
        pages_of_walls = found.squares.size();
        if (options.method == DiagramMethod::binned) of_walls = SparseLayers::bytes(found);
    }
    if (options.bands.areUsed())
        return std::size_t{options.width} * options.bands.lines(options.look) * gl::kWord + of_walls;
    if (!options.paged) {
        const std::size_t layers = walls.empty() ? 1 : 3;
        return whole * (mayBuildPerSite(scene, parameters, options) ? 1 + layers : 1) + of_walls;
    }
    const std::uint64_t pages =
        Pages::pagesNeeded(options.width, options.height, options.largest_radius, options.live_capacity) +
        pages_of_walls;
    const std::size_t tables = (of_walls > 0 ? 1 : 2) * squares * gl::kWord;  // the walls' have one of these
    return std::min<std::uint64_t>(squares + 1, pages) * kPagePixels * gl::kWord + tables + of_walls;
}

/// What routes that lead round jams keep (sim/congestion.cpp).
std::size_t bytesOfDetours(const authoring::Scene& scene, const gpu::Parameters& parameters) {
    const authoring::Detours& detours = scene.detours;
    if (detours.distances.empty()) return 0;
    const std::size_t cells = std::size_t{parameters.detour_width} * parameters.detour_height;
    const std::size_t per_block = 4 * gl::kWord * detours.ground_of_field.size() / gpu::PIXEL_GROUP_SIZE;
    return detours.ground.size() * sizeof(detours.ground.front()) +
           2 * detours.distances.size() * sizeof(float) +
           cells * (sizeof(gpu::CrowdFlow) + sizeof(float) + per_block);
}

}  // namespace

MemoryNeeded memoryNeeded(const authoring::Scene& scene) {
    const gpu::Parameters parameters = makeParameters(scene);
    MemoryNeeded needed;
    const gl::BufferCount count;
    const Buffers buffers(scene, parameters);
    // Counted like the buffers, and used for nothing else.
    const std::optional<TerrainSlopes> slopes = TerrainSlopes::of(scene);
    for (const gl::BufferCount::Counted& buffer : count.buffers())
        (isOfPeople(buffer) ? needed.people : needed.scene) += buffer.bytes;
    needed.scene += bytesOfDetours(scene, parameters);
    needed.diagram = bytesOfDiagram(scene, parameters, buffers);
    needed.frames = framesUnderWay(parameters.row_count) * bytesOfFrame(parameters.row_count);
    return needed;
}

}  // namespace throng::sim
