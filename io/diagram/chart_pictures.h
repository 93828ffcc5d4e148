// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/frame.h"
#include "recording/bake_description.h"

/// The diagram of a layout with levels lies in a plane, chart beside chart. Here it is taken apart again: a
/// picture a chart, each of which has its place in the world.
namespace throng::io {

/// Where the pictures of charts lie. Pixels are those of the plane; nothing is resampled.
struct ChartPicture {
    std::size_t chart = 0;    ///< index into BakeCharts::pictures
    glm::ivec2 first{0};      ///< pixel of the plane that is its lower left; it may reach beyond the plane
    glm::ivec2 size{0};       ///< pixels
    glm::dvec2 minimum{0.0};  ///< m, world: the lower left corner of that pixel, at home
    glm::ivec2 window{0};     ///< where its upper left pixel is, from that of the site, downwards
};

struct ChartPictures {
    std::vector<ChartPicture> pictures;  ///< the first covers the whole site, so that all lie within it
    glm::ivec2 site{0};                  ///< pixels: all of them together
    glm::dvec2 minimum{0.0};             ///< m, world: the lower left corner of the site
};

/// @param plane the size and place of a diagram; its pixels do not matter
/// @param bake whose charts have pictures
ChartPictures layPictures(const DiagramImage& plane, const recording::BakeDescription& bake);

/// The pixels of one of them: people and walls on the chart's own ground, and what they own beyond its edges,
/// but nothing beyond seams, which is in the picture of the chart there.
struct ChartPixels {
    std::vector<std::uint32_t> site, second;
    std::vector<float> distance;
    std::vector<float> height;          ///< m, of the ground; 0 where there is none of the chart
    std::vector<std::uint32_t> ground;  ///< 1 where there is some
    DiagramImage image;                 ///< of them
};
/// @param places of people, as frames have them: the third value is the chart
ChartPixels pixelsOf(const ChartPicture& picture, const DiagramImage& plane, std::span<const float> places,
                     const recording::BakeDescription& bake);

}  // namespace throng::io
