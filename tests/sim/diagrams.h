// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "sim/diagram/diagram.h"

/// Diagrams by their definition, and sites to try them with.
namespace throng::test {

struct Window {
    std::uint32_t width, height;
};

/// The definition, pixel by pixel, in the order of arithmetic that the shaders are held to.
struct Reference {
    std::vector<std::uint32_t> owners;
    std::vector<float> squared;
};

inline Reference bruteForce(Window window, const std::vector<gpu::DiagramSite>& sites) {
    Reference result;
    result.owners.assign(std::size_t{window.width} * window.height, gpu::NO_INDEX);
    result.squared.assign(result.owners.size(), INFINITY);
    for (const gpu::DiagramSite& site : sites) {
        const float limit = site.radius * site.radius;
        for (std::uint32_t y = 0; y < window.height; ++y) {
            const float dy = site.position.y - (static_cast<float>(y) + 0.5f);
            if (dy * dy > limit) continue;
            for (std::uint32_t x = 0; x < window.width; ++x) {
                const float dx = site.position.x - (static_cast<float>(x) + 0.5f);
                const float squared = dx * dx + dy * dy;
                if (squared > limit) continue;
                const std::size_t pixel = std::size_t{y} * window.width + x;
                const bool nearer = squared < result.squared[pixel];
                if (nearer || (squared == result.squared[pixel] && site.id < result.owners[pixel])) {
                    result.squared[pixel] = squared;
                    result.owners[pixel] = site.id;
                }
            }
        }
    }
    return result;
}

inline sim::DiagramOptions optionsFor(authoring::DiagramMethod method, Window window,
                                      const std::vector<gpu::DiagramSite>& sites, std::size_t walls) {
    sim::DiagramOptions options;
    options.method = method;
    options.width = window.width;
    options.height = window.height;
    options.largest_radius = 1.0f;
    for (const gpu::DiagramSite& site : sites)
        options.largest_radius = std::max(options.largest_radius, site.radius);
    options.live_capacity = static_cast<std::uint32_t>(sites.size() - walls);
    return options;
}

inline std::vector<gpu::DiagramSite> randomSites(std::mt19937& random, Window window, std::size_t count,
                                                 float least, float most) {
    std::uniform_real_distribution<float> x(-most, static_cast<float>(window.width) + most);
    std::uniform_real_distribution<float> y(-most, static_cast<float>(window.height) + most);
    std::uniform_real_distribution<float> radius(least, most);
    std::vector<gpu::DiagramSite> sites;
    for (std::uint32_t id = 0; id < count; ++id) {
        gpu::DiagramSite site{};
        site.position = {x(random), y(random)};
        // Every third site stands exactly on a pixel's centre, every fifth on a corner: ties.
        if (id % 3 == 0)
            site.position = {std::floor(site.position.x) + 0.5f, std::floor(site.position.y) + 0.5f};
        if (id % 5 == 0) site.position = {std::floor(site.position.x), std::floor(site.position.y)};
        // And every seventh exactly where an earlier one stands.
        if (id % 7 == 6) site.position = sites[id / 2].position;
        site.radius = id % 4 == 0 ? std::round(radius(random)) : radius(random);
        site.id = id;
        sites.push_back(site);
    }
    return sites;
}

}  // namespace throng::test
