// SPDX-License-Identifier: Apache-2.0
#include "sim/gates.h"

#include <algorithm>
#include <span>

namespace throng::sim {
namespace {

constexpr float kFarAway = 1.0e6f;  // m

}  // namespace

Gates::Gates(const authoring::Scene& scene, Buffers& buffers, Diagram& diagram,
             const gpu::Parameters& parameters)
    : buffers_(buffers), diagram_(diagram), moves_(scene.gate_moves) {
    if (moves_.empty()) return;
    segments_ = scene.wall_segments;
    tiles_ = scene.wall_tiles;
    sites_ = wallSites(scene, parameters);
    first_site_ = scene.people.size();
    for (const gpu::WallSegment& segment : segments_)
        open_.resize(std::max<std::size_t>(open_.size(), segment.wall + 1));
    for (const std::uint32_t wall : scene.open_at_start)
        open_.at(wall) = true;
    upload();
}

void Gates::move(double now) {
    bool moved = false;
    for (; moves_done_ < moves_.size() && moves_[moves_done_].time <= now; ++moves_done_) {
        open_.at(moves_[moves_done_].wall) = moves_[moves_done_].opens;
        moved = true;
    }
    if (moved) upload();
}

void Gates::upload() {
    std::vector<gpu::WallSegment> segments = segments_;
    for (gpu::WallSegment& segment : segments)
        if (open_[segment.wall]) {
            segment.a = segment.b = glm::vec2(kFarAway);
            segment.half_thickness = 0.0f;
        }
    std::vector<gpu::DiagramSite> sites = sites_;
    for (std::size_t tile = 0; tile < tiles_.size(); ++tile)
        if (open_[segments_[tiles_[tile].segment].wall]) sites[tile].radius = 0.0f;
    buffers_.wall_segments.upload(segments);
    buffers_.sites.upload(std::span<const gpu::DiagramSite>(sites), first_site_);
    diagram_.changeFixedSites(sites);
}

}  // namespace throng::sim
