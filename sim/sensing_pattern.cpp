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

void appendRing(const SensingGeometry& geometry, int sample, int rays, std::vector<glm::vec2>& out) {
    const float radius = ringRadius(geometry, sample);
    for (int ray = 0; ray < rays; ++ray) {
        const float share = (static_cast<float>(ray) + 0.5f) / static_cast<float>(rays) - 0.5f;
        const float angle = geometry.field_of_view * share;
        out.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
}

}  // namespace

float sensingReach(const SensingGeometry& geometry) { return ringRadius(geometry, geometry.samples_per_ray - 1); }

int raysAtRadius(const SensingGeometry& geometry, float radius) {
    const float gap = geometry.tile_radius;
    const float cosine = std::max(-1.0f, 1.0f - gap * gap / (2.0f * radius * radius));
    const float angle = std::min(std::acos(cosine), std::numbers::pi_v<float>);
    return std::max(1, static_cast<int>(std::ceil(geometry.field_of_view / angle - 1.0e-4f)));
}

std::vector<glm::vec2> fullPattern(const SensingGeometry& geometry) {
    const int rays = raysAtRadius(geometry, sensingReach(geometry));
    std::vector<glm::vec2> samples;
    for (int sample = 0; sample < geometry.samples_per_ray; ++sample) appendRing(geometry, sample, rays, samples);
    return samples;
}

std::vector<glm::vec2> thinnedPattern(const SensingGeometry& geometry, float felt_range) {
    std::vector<glm::vec2> samples;
    for (int sample = 0; sample < geometry.samples_per_ray; ++sample) {
        const float radius = ringRadius(geometry, sample);
        const bool outermost = sample + 1 == geometry.samples_per_ray;
        if (radius > felt_range || outermost) appendRing(geometry, sample, raysAtRadius(geometry, radius), samples);
    }
    std::stable_sort(samples.begin(), samples.end(),
                     [](glm::vec2 a, glm::vec2 b) { return std::atan2(a.y, a.x) < std::atan2(b.y, b.x); });
    return samples;
}

}  // namespace throng::sim
