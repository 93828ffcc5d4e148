// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/walkable.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "authoring/storeys/chart_raster.h"
#include "shaders/shared/terrain_types.h"

namespace throng::authoring {
namespace {

constexpr float kOverHead = 2.0f;  // m: over what people walk on
constexpr float kStep = 0.25f;     // m
constexpr float kHair = 1.0e-3f;   // m and rise over run, of rounding
constexpr std::size_t kMostSpots = 6'000'000;
constexpr int kLooks = 4;                           // at the ground, from one cell's middle to the next
constexpr std::array kBody = {0.35f, 0.7f, 1.05f};  // m over the ground: what is upright there is in the way

constexpr float kCell = static_cast<float>(kChartCell);

/// Whether the way from a to b goes through a face.
bool goesThrough(const TerrainTriangle& t, glm::vec3 a, glm::vec3 b) {
    const glm::vec3 corner(t.a, t.za), u(t.b, t.zb), v(t.c, t.zc), way = b - a;
    const glm::vec3 p = glm::cross(way, v);
    const float volume = glm::dot(u, p);
    if (std::abs(volume) < 1.0e-12f) return false;
    const glm::vec3 from = a - corner, q = glm::cross(from, u);
    const float s = glm::dot(from, p) / volume, r = glm::dot(way, q) / volume, at = glm::dot(v, q) / volume;
    constexpr float kOver = 1.0e-5f;
    return s >= -kOver && r >= -kOver && s + r <= 1.0f + kOver && at >= 0.0f && at <= 1.0f;
}

}  // namespace

Walkable::Walkable(const TerrainMesh& mesh, glm::dvec2 lower, glm::dvec2 upper)
    : origin_(glm::floor(0.5 * (lower + upper))),
      first_(chartCellOf(lower)),
      size_(chartCellOf(upper) + 1 - first_),
      faces_(mesh, origin_, glm::vec2(lower - origin_) - 1.0f, glm::vec2(upper - origin_) + 1.0f,
             FaceGrid::Keep::all) {
    findSpots();
    join();
}

glm::vec2 Walkable::middleOf(glm::ivec2 cell) const {
    return glm::vec2(chartCellMiddle(cell) - origin_);
}

std::pair<std::uint32_t, std::uint32_t> Walkable::spotsOf(glm::ivec2 cell) const {
    const glm::ivec2 at = cell - first_;
    if (at.x < 0 || at.y < 0 || at.x >= size_.x || at.y >= size_.y) return {0, 0};
    const std::size_t index =
        static_cast<std::size_t>(at.y) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(at.x);
    return {starts_[index], starts_[index + 1]};
}

std::uint32_t Walkable::nearestSpot(glm::ivec2 cell, double height) const {
    const auto [begin, end] = spotsOf(cell);
    std::uint32_t nearest = kNoSpot;
    for (std::uint32_t spot = begin; spot < end; ++spot)
        if (nearest == kNoSpot || std::abs(double{spots_[spot].height} - height) <
                                      std::abs(double{spots_[nearest].height} - height))
            nearest = spot;
    return nearest;
}

/// Where people can stand at a place, from the lowest up: valid until it is asked for the next time.
const std::vector<float>& Walkable::heightsAt(glm::vec2 at) const {
    hits_.clear();
    heights_.clear();
    faces_.visitHits(at, [&](const TerrainTriangle& t, float height) {
        const bool carries = t.area() > 0.0f && glm::length(t.slope()) < gpu::STEEPEST_GROUND + kHair;
        hits_.push_back({height, carries});
    });
    std::sort(hits_.begin(), hits_.end(), [](const Hit& a, const Hit& b) { return a.height < b.height; });
    for (std::size_t i = 0; i < hits_.size(); ++i) {
        if (!hits_[i].carries) continue;
        const float height = hits_[i].height;
        if (!heights_.empty() && height - heights_.back() < kHair) continue;
        const auto above = std::find_if(hits_.begin() + static_cast<std::ptrdiff_t>(i), hits_.end(),
                                        [&](const Hit& hit) { return hit.height > height + kHair; });
        if (above == hits_.end() || above->height - height > kOverHead - kHair) heights_.push_back(height);
    }
    return heights_;
}

std::optional<double> Walkable::groundNear(glm::dvec2 place, double height) const {
    std::optional<double> nearest;
    for (const float each : heightsAt(glm::vec2(place - origin_)))
        if (const double away = std::abs(double{each} - height);
            away < double{kStep} && (!nearest || away < std::abs(*nearest - height)))
            nearest = double{each};
    return nearest;
}

/// Anything upright between two places, at a body's height.
bool Walkable::isBlocked(const Standing& from, const Standing& to) const {
    bool blocked = false;
    faces_.visitBox(glm::min(from.at, to.at), glm::max(from.at, to.at), [&](const TerrainTriangle& t) {
        for (const float over : kBody)
            blocked = blocked || goesThrough(t, {from.at, from.height + over}, {to.at, to.height + over});
    });
    return blocked;
}

/// The ground at a place, where one gets there from another in a step.
std::optional<Walkable::Standing> Walkable::stepOn(const Standing& from, glm::vec2 to) const {
    std::optional<Standing> found;
    for (const float height : heightsAt(to))
        if (std::abs(height - from.height) < kStep + kHair &&
            (!found || std::abs(height - from.height) < std::abs(found->height - from.height)))
            found = Standing{to, height};
    if (found && isBlocked(from, *found)) return std::nullopt;
    return found;
}

void Walkable::findSpots() {
    starts_.reserve(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) + 1);
    for (int y = 0; y < size_.y; ++y)
        for (int x = 0; x < size_.x; ++x) {
            starts_.push_back(static_cast<std::uint32_t>(spots_.size()));
            const glm::ivec2 cell = first_ + glm::ivec2(x, y);
            for (const float height : heightsAt(middleOf(cell)))
                spots_.push_back({cell, height});
            if (spots_.size() > kMostSpots)
                throw std::invalid_argument("its faces lie above each other in too many layers");
        }
    starts_.push_back(static_cast<std::uint32_t>(spots_.size()));
}

/// A gap narrower than a cell is stepped over.
std::uint32_t Walkable::reachedFrom(std::uint32_t spot, std::size_t side) const {
    const glm::ivec2 next = spots_[spot].cell + kSides[side];
    if (const auto [begin, end] = spotsOf(next); begin == end) return kNoSpot;
    const glm::vec2 middle = middleOf(spots_[spot].cell), step = glm::vec2(kSides[side]) * kCell;
    Standing here{middle, spots_[spot].height};
    for (int look = 1; look <= kLooks; ++look) {
        const auto there = stepOn(here, middle + step * (static_cast<float>(look) / float{kLooks}));
        if (there) here = *there;
        if (!there && look == kLooks) return kNoSpot;
    }
    const std::uint32_t reached = nearestSpot(next, here.height);
    return std::abs(spots_[reached].height - here.height) < kHair ? reached : kNoSpot;
}

void Walkable::join() {
    for (std::uint32_t spot = 0; spot < spots_.size(); ++spot)
        for (const std::size_t side : {0u, 1u}) {
            const std::uint32_t next = reachedFrom(spot, side);
            if (next == kNoSpot || spots_[next].next[side + 2] != kNoSpot) continue;
            spots_[spot].next[side] = next;
            spots_[next].next[side + 2] = spot;
        }
}

double Walkable::roomBeside(std::uint32_t spot, std::size_t side) const {
    constexpr int kSteps = 16, kHalvings = 6;
    const glm::vec2 middle = middleOf(spots_[spot].cell), step = glm::vec2(kSides[side]) * kCell;
    Standing here{middle, spots_[spot].height};
    float free = 0.0f;
    const auto goOn = [&](float to) {
        const auto there = stepOn(here, middle + step * to);
        if (!there) return false;
        here = *there;
        free = to;
        return true;
    };
    for (int i = 1; i <= kSteps; ++i) {
        const float to = static_cast<float>(i) / float{kSteps};
        if (goOn(to)) continue;
        float upper = to;
        for (int halving = 0; halving < kHalvings; ++halving)
            if (const float middle_of = 0.5f * (free + upper); !goOn(middle_of)) upper = middle_of;
        break;
    }
    return double{free * kCell};
}

}  // namespace throng::authoring
