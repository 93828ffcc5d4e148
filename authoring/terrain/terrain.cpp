// SPDX-License-Identifier: Apache-2.0
#include "authoring/terrain/terrain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

namespace throng::authoring {
namespace {

constexpr float kSmallestNode = 0.25f;        // m between the lattice's nodes
constexpr double kMostNodes = 2'000'000.0;    // of the lattice
constexpr double kMostSamples = 8'000'000.0;  // of the ground, for the lattice
constexpr double kMostLooks = 1.0e9;          // at faces, while the lattice is made
constexpr float kMargin = 1.0f;               // m round the scene
constexpr float kPlaneMargin = 4.0f;          // m round the plane of charts: a step of shifts
constexpr float kLedge = 0.3f;  // m in a quarter of a metre: what is higher is no step of stairs
constexpr float kNearNode =
    0.5f;  // m: nodes round a place of charts further from its ground are beyond a ledge
constexpr float kNearFace = 0.8f;     // m: faces further from a cell's height are another storey's
constexpr float kSteepFace = 1.5f;    // rise over run: steeper faces are risers
constexpr float kLeastClimb = 0.08f;  // slopes below are nobody's stairs
constexpr int kGoesOn = 6;            // nodes beyond the edge for which the slope goes on
constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// Lattices of all charts fit together: their cells are a power of two of a metre, and at most as large as
/// the step of shifts.
TerrainRaster fittingRaster(glm::vec2 extent, double most) {
    constexpr float kLargest = 4.0f;  // m
    TerrainRaster raster = rasterOf(extent, kSmallestNode, most);
    raster.cell = std::min(std::exp2(std::ceil(std::log2(raster.cell) - 1.0e-4f)), kLargest);
    raster.width = static_cast<std::uint32_t>(std::ceil(extent.x / raster.cell)) + 1;
    raster.height = static_cast<std::uint32_t>(std::ceil(extent.y / raster.cell)) + 1;
    return raster;
}

/// Values on the lattice's nodes, of which some may be missing.
class Lattice {
  public:
    /// @param ledge m: nodes beside each other that differ by more are not each other's ground
    Lattice(const TerrainRaster& raster, std::vector<float> values,
            float ledge = std::numeric_limits<float>::infinity())
        : raster_(raster), values_(std::move(values)), ledge_(ledge) {}

    /// Goes on beyond what is known: first as it slopes, then level.
    void fill() {
        std::vector<std::uint32_t> edge;
        for (std::uint32_t i = 0; i < values_.size(); ++i)
            if (std::isnan(values_[i])) edge.push_back(i);
        for (int round = 0; !edge.empty(); ++round) {
            std::vector<std::pair<std::uint32_t, float>> found;
            for (const std::uint32_t i : edge)
                if (const float value = guess(i, round < kGoesOn); !std::isnan(value))
                    found.emplace_back(i, value);
            for (const auto& [i, value] : found)
                values_[i] = value;
            edge = missingBeside(found);
        }
    }

    /// 1 4 6 4 1 along both axes: leaves slopes as they are and takes waves as short as stairs' treads away.
    void smooth() {
        pass(1, 0);
        pass(0, 1);
    }

    const std::vector<float>& values() const { return values_; }

  private:
    float at(int x, int y) const {
        if (x < 0 || y < 0 || x >= static_cast<int>(raster_.width) || y >= static_cast<int>(raster_.height))
            return kMissing;
        return values_[static_cast<std::size_t>(y) * raster_.width + static_cast<std::size_t>(x)];
    }

    std::vector<std::uint32_t> missingBeside(
        const std::vector<std::pair<std::uint32_t, float>>& nodes) const {
        std::vector<std::uint32_t> missing;
        for (const auto& [i, value] : nodes) {
            const int x = static_cast<int>(i % raster_.width), y = static_cast<int>(i / raster_.width);
            for (int near_y = std::max(y - 1, 0); near_y <= y + 1; ++near_y)
                for (int near_x = std::max(x - 1, 0); near_x <= x + 1; ++near_x) {
                    if (near_x >= static_cast<int>(raster_.width) ||
                        near_y >= static_cast<int>(raster_.height))
                        continue;
                    if (std::isnan(at(near_x, near_y)))
                        missing.push_back(static_cast<std::uint32_t>(near_y) * raster_.width +
                                          static_cast<std::uint32_t>(near_x));
                }
        }
        std::sort(missing.begin(), missing.end());
        missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
        return missing;
    }

    float guess(std::uint32_t i, bool slopes) const {
        const int x = static_cast<int>(i % raster_.width), y = static_cast<int>(i / raster_.width);
        float sum = 0.0f;
        int count = 0;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                const float near = at(x + dx, y + dy);
                if (std::isnan(near)) continue;
                const float far = slopes ? at(x + 2 * dx, y + 2 * dy) : kMissing;
                sum += std::isnan(far) ? near : near + std::clamp(near - far, -raster_.cell, raster_.cell);
                ++count;
            }
        return count ? sum / static_cast<float>(count) : kMissing;
    }

    void pass(int dx, int dy) {
        std::vector<float> result(values_.size());
        const int w = static_cast<int>(raster_.width), h = static_cast<int>(raster_.height);
        const auto value = [&](int x, int y) {
            return values_[static_cast<std::size_t>(std::clamp(y, 0, h - 1)) * raster_.width +
                           static_cast<std::size_t>(std::clamp(x, 0, w - 1))];
        };
        const auto at = [&](int x, int y, int steps) { return value(x + steps * dx, y + steps * dy); };
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x)
                result[static_cast<std::size_t>(y) * raster_.width + static_cast<std::size_t>(x)] =
                    weighted(value(x, y), {at(x, y, -1), at(x, y, 1)}, {at(x, y, -2), at(x, y, 2)});
        values_ = std::move(result);
    }

    /// Beyond a ledge, the ground is taken to go on as it slopes on this side of it.
    float weighted(float here, std::array<float, 2> near, std::array<float, 2> far) const {
        const bool goes_on[] = {std::abs(near[0] - here) <= ledge_, std::abs(near[1] - here) <= ledge_};
        for (const std::size_t side : {0u, 1u}) {
            const float slope = goes_on[1 - side] ? here - near[1 - side] : 0.0f;
            if (!goes_on[side]) near[side] = here + slope;
            if (!goes_on[side] || std::abs(far[side] - near[side]) > ledge_)
                far[side] = near[side] + (goes_on[side] ? near[side] - here : slope);
        }
        return 0.375f * here + 0.25f * (near[0] + near[1]) + 0.0625f * (far[0] + far[1]);
    }

    const TerrainRaster& raster_;
    std::vector<float> values_;
    float ledge_;
};

}  // namespace

const PlaneGround::Cell& PlaneGround::at(glm::vec2 place) const {
    const glm::vec2 most(static_cast<float>(width) - 1.0f, static_cast<float>(height) - 1.0f);
    const glm::uvec2 at(glm::clamp(glm::floor((place - minimum) / cell), glm::vec2(0.0f), most));
    return cells[std::size_t{at.y} * width + at.x];
}

Terrain::Terrain(const TerrainMesh& mesh, bool highest, glm::dvec2 origin, glm::vec2 minimum,
                 glm::vec2 maximum)
    : highest_(highest),
      minimum_(minimum - kMargin),
      maximum_(maximum + kMargin),
      faces_(mesh, origin, minimum_, maximum_, FaceGrid::Keep::looking_up) {
    sampleLattice();
}

Terrain::Terrain(const TerrainMesh& mesh, PlaneGround ground, glm::dvec2 origin, glm::vec2 minimum,
                 glm::vec2 maximum)
    : highest_(true),
      minimum_(minimum - kPlaneMargin),
      maximum_(maximum + kPlaneMargin),
      faces_(mesh, origin, ground.lower, ground.upper, FaceGrid::Keep::looking_up),
      plane_(std::move(ground)) {
    sampleLattice();
}

std::optional<Terrain::Face> Terrain::hitAt(glm::vec2 point) const {
    if (plane_) return hitInPlane(point);
    std::optional<Face> best;
    faces_.visitHits(point, [&](const TerrainTriangle& t, float height) {
        if (best && (highest_ ? height <= best->height : height >= best->height)) return;
        best = Face{height, t.slope()};
    });
    return best;
}

std::optional<Terrain::Face> Terrain::hitInPlane(glm::vec2 point) const {
    const PlaneGround::Cell& cell = plane_->at(point);
    std::optional<Face> best;
    if (std::isnan(cell.height)) return best;
    faces_.visitHits(point - cell.shift, [&](const TerrainTriangle& t, float height) {
        const float away = std::abs(height - cell.height);
        if (away < kNearFace && (!best || away < std::abs(best->height - cell.height)))
            best = Face{height, t.slope()};
    });
    return best;
}

std::optional<float> Terrain::groundAt(glm::vec2 point) const {
    const std::optional<Face> hit = hitAt(point);
    return hit ? std::optional(hit->height) : std::nullopt;
}

float Terrain::storeysAt(glm::vec2 point) const {
    float lowest = std::numeric_limits<float>::max(), highest = std::numeric_limits<float>::lowest();
    faces_.visitHits(point, [&](const TerrainTriangle&, float height) {
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    });
    return std::max(highest - lowest, 0.0f);
}

/// Each node holds the mean round it, so that treads and risers count by their share; where the ground covers
/// only a part of that, it is guessed from the nodes beside it.
void Terrain::sampleLattice() {
    lattice_ = plane_ ? fittingRaster(maximum_ - minimum_, kMostNodes)
                      : rasterOf(maximum_ - minimum_, kSmallestNode, kMostNodes);
    const int side =
        std::clamp(static_cast<int>(std::sqrt(kMostSamples / static_cast<double>(lattice_.count()))), 1, 4);
    const double layers = faces_.layers();
    if (static_cast<double>(lattice_.count()) * side * side * layers > kMostLooks)
        throw std::invalid_argument(
            "its faces lie above each other in too many layers: export the ground alone");
    std::vector<float> heights(lattice_.count(), kMissing), slopes(lattice_.count(), kMissing);
    std::vector<float> partial = heights;
    for (std::uint32_t y = 0; y < lattice_.height; ++y)
        for (std::uint32_t x = 0; x < lattice_.width; ++x) {
            float height = 0.0f, slope = 0.0f;
            int hits = 0, looks = side * side;
            const std::optional<Face> middle = plane_ ? hitAt(nodePlace(x, y)) : std::nullopt;
            for (int i = 0; i < side * side; ++i) {
                const glm::vec2 offset =
                    (glm::vec2(i % side, i / side) + 0.5f) / static_cast<float>(side) - 0.5f;
                const std::optional<Face> hit = hitAt(nodePlace(x, y) + offset * lattice_.cell);
                if (!hit) continue;
                if (middle && std::abs(hit->height - middle->height) > kLedge) {
                    --looks;
                    continue;
                }
                ++hits;
                height += hit->height;
                const float rise = glm::length(hit->slope);
                slope += rise < kSteepFace ? rise : 0.0f;
            }
            const std::size_t node = std::size_t{y} * lattice_.width + x;
            if (hits > 0) partial[node] = height / static_cast<float>(hits);
            if (hits == 0 || hits < looks) continue;
            heights[node] = partial[node];
            slopes[node] = slope / static_cast<float>(hits);
        }
    if (std::all_of(heights.begin(), heights.end(), [](float value) { return std::isnan(value); }))
        heights = partial;
    Lattice smooth(lattice_, std::move(heights), ledge()), faces(lattice_, std::move(slopes));
    for (Lattice* each : {&smooth, &faces}) {
        each->fill();
        each->smooth();
    }
    nodes_.resize(lattice_.count());
    for (std::size_t i = 0; i < nodes_.size(); ++i)
        nodes_[i].height = std::isnan(smooth.values()[i]) ? 0.0f : smooth.values()[i];
    for (std::uint32_t y = 0; y < lattice_.height; ++y)
        for (std::uint32_t x = 0; x < lattice_.width; ++x) {
            const std::size_t node = std::size_t{y} * lattice_.width + x;
            const float climb = glm::length(slopeAt(nodePlace(x, y)));
            const float face = std::isnan(faces.values()[node]) ? climb : faces.values()[node];
            nodes_[node].steps = climb > kLeastClimb ? std::clamp(1.0f - face / climb, 0.0f, 1.0f) : 0.0f;
        }
}

float Terrain::smoothAt(glm::vec2 point) const {
    const glm::vec2 most(static_cast<float>(lattice_.width) - 1.001f,
                         static_cast<float>(lattice_.height) - 1.001f);
    const glm::vec2 at = glm::clamp((point - minimum_) / lattice_.cell, glm::vec2(0.0f), most);
    // Of many nodes, floats do not tell the last two apart.
    const glm::uvec2 cell = glm::min(glm::uvec2(at), glm::uvec2(lattice_.width - 2, lattice_.height - 2));
    const glm::vec2 f = at - glm::vec2(cell);
    const gpu::TerrainNode* low = &nodes_[std::size_t{cell.y} * lattice_.width + cell.x];
    const gpu::TerrainNode* high = low + lattice_.width;
    std::array<float, 4> heights = {low[0].height, low[1].height, high[0].height, high[1].height};
    if (plane_) leaveOutOthers(point, heights);
    return glm::mix(glm::mix(heights[0], heights[1], f.x), glm::mix(heights[2], heights[3], f.x), f.y);
}

/// Of the nodes round a place, those beyond a ledge take the mean of the others.
void Terrain::leaveOutOthers(glm::vec2 point, std::array<float, 4>& heights) const {
    const std::optional<Face> here = hitAt(point);
    if (!here) return;
    const auto is_near = [&](float height) { return std::abs(height - here->height) < kNearNode; };
    float sum = 0.0f, count = 0.0f;
    for (const float height : heights)
        if (is_near(height)) {
            sum += height;
            count += 1.0f;
        }
    if (count == 4.0f) return;
    for (float& height : heights)
        if (!is_near(height)) height = count > 0.0f ? sum / count : here->height;
}

float Terrain::ledge() const {
    return plane_ ? std::max(kLedge, 1.2f * lattice_.cell) : std::numeric_limits<float>::infinity();
}

/// A ledge is no slope: beside one, the slope is that of one's own side.
glm::vec2 Terrain::slopeAt(glm::vec2 point) const {
    const float cell = lattice_.cell, here = smoothAt(point);
    const auto along = [&](glm::vec2 way) {
        const float before = smoothAt(point - way), after = smoothAt(point + way);
        const bool came = std::abs(here - before) <= ledge(), goes_on = std::abs(after - here) <= ledge();
        if (came && goes_on) return (after - before) / (2.0f * cell);
        if (came) return (here - before) / cell;
        return goes_on ? (after - here) / cell : 0.0f;
    };
    return {along({cell, 0.0f}), along({0.0f, cell})};
}

float Terrain::stepsAt(glm::vec2 point) const {
    const glm::vec2 most(static_cast<float>(lattice_.width) - 1.0f,
                         static_cast<float>(lattice_.height) - 1.0f);
    const glm::uvec2 node(glm::clamp(glm::round((point - minimum_) / lattice_.cell), glm::vec2(0.0f), most));
    return nodes_[std::size_t{node.y} * lattice_.width + node.x].steps;
}

Terrain::Face Terrain::faceAt(glm::vec2 point) const {
    const std::optional<Face> hit = hitAt(point);
    return hit ? *hit : Face{smoothAt(point), slopeAt(point)};
}

}  // namespace throng::authoring
