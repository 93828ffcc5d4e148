// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/patch_sizes.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "shaders/shared/scene_types.h"

namespace throng::authoring {
namespace {

/// Whether one may stand on both, as far as the boxes around them tell.
bool mayMeet(const Patch& one, const Patch& other) {
    const auto box = [](const Patch& patch) {
        glm::dvec2 lower = patch.polygon.front(), upper = lower;
        for (const glm::dvec2 point : patch.polygon) {
            lower = glm::min(lower, point);
            upper = glm::max(upper, point);
        }
        return std::pair(lower, upper);
    };
    const auto [lower, upper] = box(one);
    const auto [other_lower, other_upper] = box(other);
    return one.level == other.level && glm::all(glm::lessThanEqual(lower, other_upper)) &&
           glm::all(glm::lessThanEqual(other_lower, upper));
}

}  // namespace

SizeBounds sizeBounds(const std::vector<Patch>& patches) {
    SizeBounds bounds;
    if (std::ranges::all_of(patches, [](const Patch& patch) { return patch.size == 1.0; })) return bounds;
    for (const Patch& patch : patches) {
        double least = 1.0, most = 1.0;
        for (const Patch& other : patches) {
            if (!mayMeet(patch, other)) continue;
            least *= std::min(other.size, 1.0);
            most *= std::max(other.size, 1.0);
        }
        bounds.least = std::min(bounds.least, static_cast<float>(least));
        bounds.most = std::max(bounds.most, static_cast<float>(most));
    }
    return {std::max(bounds.least, gpu::LEAST_SIZE), std::min(bounds.most, gpu::MOST_SIZE)};
}

}  // namespace throng::authoring
