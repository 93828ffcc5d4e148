// SPDX-License-Identifier: Apache-2.0
#include "sim/sensing_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace throng::sim {
namespace {

float ringRadius(const SensingGeometry& geometry, int sample) {
    return geometry.body_radius + static_cast<float>(sample) * geometry.tile_radius;
}

bool isAllRound(const SensingGeometry& geometry) {
    return geometry.field_of_view > 2.0f * std::numbers::pi_v<float> - 1.0e-3f;
}

void appendRing(const SensingGeometry& geometry, int sample, int rays, std::vector<glm::vec2>& out) {
    const float radius = ringRadius(geometry, sample);
    // The outermost rays lie on the edges of the field of view; all round, the last gap is the one back to
    // the first ray.
    const int gaps = isAllRound(geometry) ? rays : rays - 1;
    for (int ray = 0; ray < rays; ++ray) {
        const float share = gaps > 0 ? static_cast<float>(ray) / static_cast<float>(gaps) - 0.5f : 0.0f;
        const float angle = geometry.field_of_view * share;
        out.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
}

}  // namespace

float sensingReach(const SensingGeometry& geometry) {
    return ringRadius(geometry, geometry.samples_per_ray - 1);
}

int raysAtRadius(const SensingGeometry& geometry, float radius) {
    const float gap = geometry.tile_radius;
    const float cosine = std::max(-1.0f, 1.0f - gap * gap / (2.0f * radius * radius));
    const float angle = std::min(std::acos(cosine), std::numbers::pi_v<float>);
    const int gaps = std::max(1, static_cast<int>(std::ceil(geometry.field_of_view / angle - 1.0e-4f)));
    return isAllRound(geometry) ? gaps : gaps + 1;
}

std::vector<glm::vec2> fullPattern(const SensingGeometry& geometry) {
    const int rays = raysAtRadius(geometry, sensingReach(geometry));
    std::vector<glm::vec2> samples;
    for (int sample = 0; sample < geometry.samples_per_ray; ++sample)
        appendRing(geometry, sample, rays, samples);
    return samples;
}

std::vector<glm::vec2> thinnedPattern(const SensingGeometry& geometry, float felt_range) {
    std::vector<glm::vec2> samples;
    for (int sample = 0; sample < geometry.samples_per_ray; ++sample) {
        const float radius = ringRadius(geometry, sample);
        const bool outermost = sample + 1 == geometry.samples_per_ray;
        if (radius > felt_range || outermost)
            appendRing(geometry, sample, raysAtRadius(geometry, radius), samples);
    }
    std::stable_sort(samples.begin(), samples.end(),
                     [](glm::vec2 a, glm::vec2 b) { return std::atan2(a.y, a.x) < std::atan2(b.y, b.x); });
    return samples;
}

}  // namespace throng::sim
