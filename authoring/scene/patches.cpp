// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/patches.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

#include "authoring/scene/raster.h"

namespace throng::authoring {
namespace {

/// Times before and after everything.
constexpr double kAlways = 1.0e9;  // s

double beginOf(const Patch& patch) {
    return patch.from > 0.0 ? patch.from : -kAlways;
}

/// Whether the pieces from a to b and from c to d cross.
bool cross(glm::vec2 a, glm::vec2 b, glm::vec2 c, glm::vec2 d) {
    const auto side = [](glm::vec2 from, glm::vec2 to, glm::vec2 point) {
        const glm::vec2 way = to - from, off = point - from;
        return way.x * off.y - way.y * off.x > 0.0f;
    };
    return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
}

/// Which share of a cell lies within an outline.
float shareWithin(const FieldGrid& grid, std::uint32_t cell, const LocalPolygon& outline) {
    constexpr int kAcross = 4;
    const glm::vec2 corner = grid.minimum + glm::vec2(cell % grid.width, cell / grid.width) * grid.cell_size;
    int within = 0;
    for (int y = 0; y < kAcross; ++y)
        for (int x = 0; x < kAcross; ++x) {
            const glm::vec2 at = (glm::vec2(x, y) + 0.5f) / float{kAcross};
            within += insidePolygon(outline, corner + at * grid.cell_size) ? 1 : 0;
        }
    return static_cast<float>(within) / float{kAcross * kAcross};
}

Patches::Costs costsFor(const Patch& patch, const LocalPolygon& outline, const FieldGrid& coarse) {
    Patches::Costs costs{beginOf(patch), patch.until.value_or(kAlways), {}};
    const Box box = boundsOf(outline, 0.0f);
    for (std::uint32_t y = row(coarse, box.lower.y); y <= row(coarse, box.upper.y); ++y)
        for (std::uint32_t x = column(coarse, box.lower.x); x <= column(coarse, box.upper.x); ++x) {
            const std::uint32_t cell = y * coarse.width + x;
            const float share = shareWithin(coarse, cell, outline);
            if (share > 0.0f)
                costs.cells.emplace_back(cell, 1.0f + (static_cast<float>(patch.cost) - 1.0f) * share);
        }
    return costs;
}

}  // namespace

bool CostlyGround::meets(glm::vec2 a, glm::vec2 b) const {
    if (insidePolygon(outline, a) || insidePolygon(outline, b)) return true;
    for (std::size_t i = 0; i < outline.size(); ++i)
        if (cross(a, b, outline[i], outline[(i + 1) % outline.size()])) return true;
    return false;
}

bool areOnTheirFloors(const Layout& layout, Diagnostics& diagnostics) {
    bool all = true;
    for (const Patch& patch : layout.patches) {
        const Level& level = layout.levels[patch.level];
        glm::dvec2 lower(std::numeric_limits<double>::max()), upper = -lower;
        for (const glm::dvec2 point : level.floor) {
            lower = glm::min(lower, point);
            upper = glm::max(upper, point);
        }
        const auto beyond = std::ranges::find_if(
            patch.polygon, [&](glm::dvec2 point) { return point != glm::clamp(point, lower, upper); });
        if (beyond == patch.polygon.end()) continue;
        all = false;
        diagnostics.error(
            patch.where,
            fmt::format("patch `{}` has a point [{:.6g}, {:.6g}] beyond the floor of level `{}`", patch.id,
                        beyond->x, beyond->y, level.id),
            "end it at the floor's edge, or move it to another level");
    }
    return all;
}

std::vector<CostlyGround> costlyGround(const Layout& layout, const Rebase& rebase) {
    std::vector<CostlyGround> costly;
    for (const Patch& patch : layout.patches)
        if (patch.cost > 1.0)
            costly.push_back(
                {rebase.local(patch.polygon), static_cast<float>(patch.cost), patch.isForATime()});
    return costly;
}

Patches buildPatches(const Layout& layout, const Rebase& rebase, const FieldGrid& coarse) {
    Patches patches;
    for (const Patch& patch : layout.patches) {
        const LocalPolygon outline = rebase.local(patch.polygon);
        if (patch.pace != 1.0 || patch.size != 1.0) {
            const Box box = boundsOf(outline, 0.0f);
            const gpu::Patch ground{
                box.lower,
                box.upper,
                static_cast<float>(patch.pace),
                static_cast<float>(beginOf(patch)),
                static_cast<float>(patch.until.value_or(kAlways)),
                static_cast<gpu::uint>(patches.points.size()),
                static_cast<gpu::uint>(outline.size()),
                static_cast<float>(patch.size),
            };
            if (patch.pace != 1.0) patches.slow.push_back(ground);
            if (patch.size != 1.0) patches.sized.push_back(ground);
            patches.points.insert(patches.points.end(), outline.begin(), outline.end());
        }
        if (patch.cost > 1.0 && patch.isForATime())
            patches.for_a_time.push_back(costsFor(patch, outline, coarse));
    }
    return patches;
}

void chargePatches(const std::vector<CostlyGround>& costly, const FieldGrid& grid, std::vector<float>& cost) {
    for (const CostlyGround& ground : costly)
        if (!ground.is_for_a_time)
            visitInside(grid, ground.outline, [&](std::uint32_t cell, glm::vec2) {
                cost[cell] = charged(cost[cell], ground.cost);
            });
}

void visitCostly(const std::vector<CostlyGround>& costly, const FieldGrid& grid,
                 const std::function<void(std::uint32_t)>& visit) {
    for (const CostlyGround& ground : costly)
        visitInside(grid, ground.outline, [&](std::uint32_t cell, glm::vec2) { visit(cell); });
}

}  // namespace throng::authoring
