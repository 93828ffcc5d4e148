// SPDX-License-Identifier: Apache-2.0
#include "authoring/terrain/terrain.h"

#include <algorithm>
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
constexpr double kMostCells = 1'000'000.0;
constexpr double kMostLooks = 1.0e9;  // at faces, while the lattice is made
constexpr std::size_t kMostItems = 32'000'000;
constexpr float kMargin = 1.0f;       // m round the scene
constexpr float kSteepFace = 1.5f;    // rise over run: steeper faces are risers
constexpr float kLeastClimb = 0.08f;  // slopes below are nobody's stairs
constexpr int kGoesOn = 6;            // nodes beyond the edge for which the slope goes on
constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

float cross(glm::vec2 a, glm::vec2 b) {
    return a.x * b.y - a.y * b.x;
}

/// Rise over run, both axes.
glm::vec2 slopeOf(const TerrainTriangle& t) {
    const float area = cross(t.b, t.c);
    return glm::vec2(t.zb * t.c.y - t.zc * t.b.y, t.zc * t.b.x - t.zb * t.c.x) / area;
}

TerrainRaster rasterOf(glm::vec2 extent, float least, double most) {
    TerrainRaster raster;
    raster.cell = std::max(least, static_cast<float>(std::sqrt(double{extent.x} * double{extent.y} / most)));
    // What is long and thin has more of them along its edges than its area tells.
    const auto along = [&](float length) { return std::ceil(double{length} / double{raster.cell}) + 1.0; };
    while (along(extent.x) * along(extent.y) > 1.5 * most + 1024.0)
        raster.cell *= 1.25f;
    raster.width = static_cast<std::uint32_t>(std::ceil(extent.x / raster.cell)) + 1;
    raster.height = static_cast<std::uint32_t>(std::ceil(extent.y / raster.cell)) + 1;
    return raster;
}

/// Values on the lattice's nodes, of which some may be missing.
class Lattice {
  public:
    Lattice(const TerrainRaster& raster, std::vector<float> values)
        : raster_(raster), values_(std::move(values)) {}

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
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x)
                result[static_cast<std::size_t>(y) * raster_.width + static_cast<std::size_t>(x)] =
                    0.375f * value(x, y) + 0.25f * (value(x - dx, y - dy) + value(x + dx, y + dy)) +
                    0.0625f * (value(x - 2 * dx, y - 2 * dy) + value(x + 2 * dx, y + 2 * dy));
        values_ = std::move(result);
    }

    const TerrainRaster& raster_;
    std::vector<float> values_;
};

}  // namespace

Terrain::Terrain(const TerrainMesh& mesh, bool highest, glm::dvec2 origin, glm::vec2 minimum,
                 glm::vec2 maximum)
    : highest_(highest), minimum_(minimum - kMargin), maximum_(maximum + kMargin) {
    keepTriangles(mesh, origin);
    sortIntoCells();
    sampleLattice();
}

void Terrain::keepTriangles(const TerrainMesh& mesh, glm::dvec2 origin) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3& a = mesh.positions[mesh.indices[i]];
        const glm::dvec3& b = mesh.positions[mesh.indices[i + 1]];
        const glm::dvec3& c = mesh.positions[mesh.indices[i + 2]];
        TerrainTriangle t{};
        t.a = glm::vec2(glm::dvec2(a) - origin);
        t.b = glm::vec2(glm::dvec2(b - a));
        t.c = glm::vec2(glm::dvec2(c - a));
        const glm::vec2 lower = t.a + glm::min(glm::vec2(0.0f), glm::min(t.b, t.c));
        const glm::vec2 upper = t.a + glm::max(glm::vec2(0.0f), glm::max(t.b, t.c));
        if (lower.x > maximum_.x || lower.y > maximum_.y || upper.x < minimum_.x || upper.y < minimum_.y)
            continue;
        // Upright and overhanging faces, and slivers, carry nobody.
        if (!(cross(t.b, t.c) > 1.0e-7f)) continue;
        t.za = static_cast<float>(a.z);
        t.zb = static_cast<float>(b.z - a.z);
        t.zc = static_cast<float>(c.z - a.z);
        triangles_.push_back(t);
    }
}

void Terrain::sortIntoCells() {
    const glm::vec2 extent = maximum_ - minimum_;
    const double about = std::clamp(static_cast<double>(triangles_.size()), 16.0, kMostCells);
    float least = 0.25f;
    const auto range = [&](const TerrainTriangle& t, auto&& visit) {
        const auto cellOf = [&](glm::vec2 p) {
            const glm::vec2 at = (p - minimum_) / cells_.cell;
            return glm::uvec2(
                glm::clamp(at, glm::vec2(0.0f), glm::vec2(cells_.width - 1, cells_.height - 1)));
        };
        // A hair wider, so that rounding loses no face at a cell's edge.
        const glm::vec2 hair(1.0e-4f * cells_.cell);
        const glm::uvec2 first = cellOf(t.a + glm::min(glm::vec2(0.0f), glm::min(t.b, t.c)) - hair);
        const glm::uvec2 last = cellOf(t.a + glm::max(glm::vec2(0.0f), glm::max(t.b, t.c)) + hair);
        visit(first, last);
    };
    for (;; least = 2.0f * cells_.cell) {
        cells_ = rasterOf(extent, least, about);
        std::size_t items = 0;
        for (const TerrainTriangle& t : triangles_)
            range(t, [&](glm::uvec2 first, glm::uvec2 last) {
                items += std::size_t{last.x - first.x + 1} * (last.y - first.y + 1);
            });
        if (items <= std::max(kMostItems, 2 * triangles_.size()) || cells_.count() <= 4) break;
    }
    starts_.assign(cells_.count() + 1, 0);
    const auto each = [&](auto&& visit) {
        for (std::uint32_t i = 0; i < triangles_.size(); ++i)
            range(triangles_[i], [&](glm::uvec2 first, glm::uvec2 last) {
                for (std::uint32_t y = first.y; y <= last.y; ++y)
                    for (std::uint32_t x = first.x; x <= last.x; ++x)
                        visit(std::size_t{y} * cells_.width + x, i);
            });
    };
    each([&](std::size_t cell, std::uint32_t) { ++starts_[cell + 1]; });
    for (std::size_t cell = 0; cell < cells_.count(); ++cell)
        starts_[cell + 1] += starts_[cell];
    items_.resize(starts_.back());
    std::vector<std::uint32_t> cursors(starts_.begin(), starts_.end() - 1);
    each([&](std::size_t cell, std::uint32_t i) { items_[cursors[cell]++] = i; });
}

template <class Visit>
void Terrain::visitHits(glm::vec2 point, Visit visit) const {
    const glm::vec2 at = (point - minimum_) / cells_.cell;
    if (!(at.x >= 0.0f && at.y >= 0.0f && at.x < static_cast<float>(cells_.width) &&
          at.y < static_cast<float>(cells_.height)))
        return;
    const std::size_t cell = static_cast<std::size_t>(at.y) * cells_.width + static_cast<std::size_t>(at.x);
    for (std::uint32_t i = starts_[cell]; i < starts_[cell + 1]; ++i) {
        const TerrainTriangle& t = triangles_[items_[i]];
        const glm::vec2 p = point - t.a;
        const float area = cross(t.b, t.c);
        const float v = cross(p, t.c) / area, w = cross(t.b, p) / area;
        constexpr float kHair = 1.0e-5f;  // neighbours overlap by it, so that no point falls between them
        if (v >= -kHair && w >= -kHair && v + w <= 1.0f + kHair) visit(t, t.za + v * t.zb + w * t.zc);
    }
}

std::optional<Terrain::Face> Terrain::hitAt(glm::vec2 point) const {
    std::optional<Face> best;
    visitHits(point, [&](const TerrainTriangle& t, float height) {
        if (best && (highest_ ? height <= best->height : height >= best->height)) return;
        best = Face{height, slopeOf(t)};
    });
    return best;
}

std::optional<float> Terrain::groundAt(glm::vec2 point) const {
    const std::optional<Face> hit = hitAt(point);
    return hit ? std::optional(hit->height) : std::nullopt;
}

float Terrain::storeysAt(glm::vec2 point) const {
    float lowest = std::numeric_limits<float>::max(), highest = std::numeric_limits<float>::lowest();
    visitHits(point, [&](const TerrainTriangle&, float height) {
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    });
    return std::max(highest - lowest, 0.0f);
}

/// Each node holds the mean round it, so that treads and risers count by their share; where the ground covers
/// only a part of that, it is guessed from the nodes beside it.
void Terrain::sampleLattice() {
    lattice_ = rasterOf(maximum_ - minimum_, kSmallestNode, kMostNodes);
    const int side =
        std::clamp(static_cast<int>(std::sqrt(kMostSamples / static_cast<double>(lattice_.count()))), 1, 4);
    const double layers = static_cast<double>(items_.size()) / static_cast<double>(cells_.count());
    if (static_cast<double>(lattice_.count()) * side * side * layers > kMostLooks)
        throw std::invalid_argument(
            "its faces lie above each other in too many layers: export the ground alone");
    std::vector<float> heights(lattice_.count(), kMissing), slopes(lattice_.count(), kMissing);
    std::vector<float> partial = heights;
    for (std::uint32_t y = 0; y < lattice_.height; ++y)
        for (std::uint32_t x = 0; x < lattice_.width; ++x) {
            float height = 0.0f, slope = 0.0f;
            int hits = 0;
            for (int i = 0; i < side * side; ++i) {
                const glm::vec2 offset =
                    (glm::vec2(i % side, i / side) + 0.5f) / static_cast<float>(side) - 0.5f;
                const std::optional<Face> hit = hitAt(nodePlace(x, y) + offset * lattice_.cell);
                if (!hit) continue;
                ++hits;
                height += hit->height;
                const float rise = glm::length(hit->slope);
                slope += rise < kSteepFace ? rise : 0.0f;
            }
            const std::size_t node = std::size_t{y} * lattice_.width + x;
            if (hits > 0) partial[node] = height / static_cast<float>(hits);
            if (hits < side * side) continue;
            heights[node] = partial[node];
            slopes[node] = slope / static_cast<float>(hits);
        }
    if (std::all_of(heights.begin(), heights.end(), [](float value) { return std::isnan(value); }))
        heights = partial;
    Lattice smooth(lattice_, std::move(heights)), faces(lattice_, std::move(slopes));
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
    return glm::mix(glm::mix(low[0].height, low[1].height, f.x),
                    glm::mix(high[0].height, high[1].height, f.x), f.y);
}

glm::vec2 Terrain::slopeAt(glm::vec2 point) const {
    const float d = lattice_.cell;
    return glm::vec2(smoothAt(point + glm::vec2(d, 0.0f)) - smoothAt(point - glm::vec2(d, 0.0f)),
                     smoothAt(point + glm::vec2(0.0f, d)) - smoothAt(point - glm::vec2(0.0f, d))) /
           (2.0f * d);
}

Terrain::Face Terrain::faceAt(glm::vec2 point) const {
    const std::optional<Face> hit = hitAt(point);
    return hit ? *hit : Face{smoothAt(point), slopeAt(point)};
}

}  // namespace throng::authoring
