// SPDX-License-Identifier: Apache-2.0
#include "io/diagram/chart_pictures.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "authoring/terrain/terrain.h"

namespace throng::io {
namespace {

using Cells = recording::BakeCharts::Cells;

constexpr std::uint32_t kNoChart = 0xffu;

/// Byte 0: whose part of the plane; byte 1: whose ground.
std::uint32_t chartsAt(const Cells& cells, glm::vec2 place) {
    const glm::vec2 at = (place - cells.minimum) / cells.size;
    if (at.x < 0.0f || at.y < 0.0f || at.x >= static_cast<float>(cells.width) ||
        at.y >= static_cast<float>(cells.height))
        return kNoChart | kNoChart << 8;
    return cells.charts[static_cast<std::size_t>(at.y) * cells.width + static_cast<std::size_t>(at.x)];
}

ChartPicture lay(const DiagramImage& plane, const recording::BakeDescription& bake, std::size_t chart) {
    const double scale = plane.pixels_per_metre;
    const recording::BakeCharts::Picture& about = bake.charts->pictures[chart];
    // World coordinates of the plane's corner, as they would be if the chart stayed where it lies.
    const glm::dvec2 corner = bake.scene_origin + glm::dvec2(plane.minimum) - bake.charts->shifts[chart];
    ChartPicture picture;
    picture.chart = chart;
    picture.first = glm::ivec2(glm::floor((about.lower - corner) * scale));
    picture.size = glm::ivec2(glm::ceil((about.upper - corner) * scale)) - picture.first;
    picture.minimum = corner + glm::dvec2(picture.first) / scale;
    return picture;
}

/// Programs that make room for what the first part of a file covers read no further than that.
void coverSite(ChartPictures& all, double scale) {
    ChartPicture& first = all.pictures.front();
    const glm::ivec2 grown = glm::ivec2(glm::round((first.minimum - all.minimum) * scale));
    first.first -= grown;
    first.minimum -= glm::dvec2(grown) / scale;
    first.size = all.site;
    first.window = glm::ivec2(0);
}

class Taking {
  public:
    Taking(const ChartPicture& picture, const DiagramImage& plane, std::span<const float> places,
           const recording::BakeDescription& bake)
        : picture_(picture), plane_(plane), places_(places), bake_(bake) {}

    ChartPixels run() {
        const std::size_t count = static_cast<std::size_t>(picture_.size.x) * picture_.size.y;
        result_.site.assign(count, kNone);
        result_.distance.assign(count, 0.0f);
        result_.height.assign(count, 0.0f);
        result_.ground.assign(count, 0);
        if (!plane_.second.empty()) result_.second.assign(count, kNone);
        const glm::ivec2 from = glm::max(picture_.first, 0);
        const glm::ivec2 to =
            glm::min(picture_.first + picture_.size,
                     glm::ivec2(static_cast<int>(plane_.width), static_cast<int>(plane_.height)));
        for (glm::ivec2 pixel{from}; pixel.y < to.y; ++pixel.y)
            for (pixel.x = from.x; pixel.x < to.x; ++pixel.x)
                take(pixel);
        describe();
        return std::move(result_);
    }

  private:
    void take(glm::ivec2 pixel) {
        const glm::vec2 place = plane_.minimum + (glm::vec2(pixel) + 0.5f) / plane_.pixels_per_metre;
        const std::uint32_t charts = chartsAt(bake_.charts->cells, place);
        const std::uint32_t owner = charts >> 8 & kNoChart;
        if ((charts & kNoChart) != picture_.chart || (owner != kNoChart && owner != picture_.chart)) return;
        const std::size_t from =
            static_cast<std::size_t>(pixel.y) * plane_.width + static_cast<std::size_t>(pixel.x);
        const glm::ivec2 at = pixel - picture_.first;
        const std::size_t to = static_cast<std::size_t>(at.y) * static_cast<std::size_t>(picture_.size.x) +
                               static_cast<std::size_t>(at.x);
        const bool is_ground = owner == picture_.chart;
        if (is_ground) {
            result_.ground[to] = 1;
            result_.height[to] = bake_.terrain->surface->smoothAt(place);
        }
        if (is_ground ? isAboveOrBelow(plane_.site[from]) : !isHere(plane_.site[from])) return;
        result_.site[to] = plane_.site[from];
        result_.distance[to] = plane_.distance[from];
        if (!plane_.second.empty()) result_.second[to] = plane_.second[from];
    }

    struct Person {
        std::uint32_t chart = kNoChart;  ///< whose ground it stands on
        glm::vec2 place;                 ///< m, in the plane, where it lies of this picture's chart
    };

    /// Who has walked over a seam is taken to the other chart with the next decision, but stands on its
    /// ground.
    Person personAt(std::uint32_t site) const {
        const std::span<const float> told = places_.subspan(std::size_t{site} * kComponents, kComponents);
        const glm::vec2 place(told[0], told[1]);
        const auto chart = static_cast<std::size_t>(std::lround(told[2]));
        if (chart >= bake_.charts->shifts.size()) return {kNoChart, place};
        const std::uint32_t owner = chartsAt(bake_.charts->cells, place) >> 8 & kNoChart;
        const glm::vec2 moved(bake_.charts->shifts[picture_.chart] - bake_.charts->shifts[chart]);
        return {owner == kNoChart ? static_cast<std::uint32_t>(chart) : owner, place + moved};
    }

    /// Whether somebody stands on this chart, and is not only seen over a seam of it.
    bool isHere(std::uint32_t site) const {
        if (site >= plane_.agent_count) return site != kNone;
        return personAt(site).chart == picture_.chart;
    }

    /// Whether somebody is seen over a seam, but walks over or under this chart's own ground: on the upper
    /// end of a stair, say, beneath which the floor goes on.
    bool isAboveOrBelow(std::uint32_t site) const {
        if (site >= plane_.agent_count) return false;
        const Person person = personAt(site);
        if (person.chart == picture_.chart || person.chart == kNoChart) return false;
        return (chartsAt(bake_.charts->cells, person.place) >> 8 & kNoChart) == picture_.chart;
    }

    void describe() {
        DiagramImage& image = result_.image;
        image.width = static_cast<std::uint32_t>(picture_.size.x);
        image.height = static_cast<std::uint32_t>(picture_.size.y);
        image.pixels_per_metre = plane_.pixels_per_metre;
        image.agent_count = plane_.agent_count;
        image.wall_count = plane_.wall_count;
        image.site = result_.site;
        image.distance = result_.distance;
        image.second = result_.second;
    }

    const ChartPicture& picture_;
    const DiagramImage& plane_;
    std::span<const float> places_;
    const recording::BakeDescription& bake_;
    ChartPixels result_;
};

}  // namespace

ChartPictures layPictures(const DiagramImage& plane, const recording::BakeDescription& bake) {
    const double scale = plane.pixels_per_metre;
    ChartPictures all;
    for (std::size_t chart = 0; chart < bake.charts->pictures.size(); ++chart)
        all.pictures.push_back(lay(plane, bake, chart));
    all.minimum = all.pictures.front().minimum;
    for (const ChartPicture& picture : all.pictures)
        all.minimum = glm::min(all.minimum, picture.minimum);
    const auto fromLowerLeft = [&](const ChartPicture& picture) {
        return glm::ivec2(glm::round((picture.minimum - all.minimum) * scale));
    };
    for (const ChartPicture& picture : all.pictures)
        all.site = glm::max(all.site, fromLowerLeft(picture) + picture.size);
    for (ChartPicture& picture : all.pictures) {
        const glm::ivec2 at = fromLowerLeft(picture);
        picture.window = {at.x, all.site.y - at.y - picture.size.y};
    }
    coverSite(all, scale);
    return all;
}

ChartPixels pixelsOf(const ChartPicture& picture, const DiagramImage& plane, std::span<const float> places,
                     const recording::BakeDescription& bake) {
    return Taking(picture, plane, places, bake).run();
}

}  // namespace throng::io
