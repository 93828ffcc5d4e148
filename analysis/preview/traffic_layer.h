// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo.h>

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "io/bake_reader.h"

namespace throng::analysis {

/// How metres of a bake become pixels of a picture.
struct PlateView {
    double left = 0.0, top = 0.0;  ///< px: where the drawing begins
    glm::dvec2 minimum{0.0}, maximum{0.0};
    double scale = 1.0;  ///< px per m

    glm::dvec2 toPixel(glm::dvec2 place) const {
        return {left + (place.x - minimum.x) * scale, top + (maximum.y - place.y) * scale};
    }
};

/// Lanes, crossings, signals and vehicles in a picture.
class TrafficLayer {
  public:
    /// Throws InputError where the bake's vehicles cannot be read.
    explicit TrafficLayer(const io::Bake& bake);
    void drawStreet(cairo_t* context, const PlateView& view) const;
    void drawFrame(cairo_t* context, const PlateView& view, std::uint32_t frame) const;

  private:
    void drawCrossing(cairo_t* context, const PlateView& view, const authoring::Zebra& crossing) const;
    void drawLights(cairo_t* context, const PlateView& view, double time) const;
    void drawVehicle(cairo_t* context, const PlateView& view, std::uint32_t frame, std::size_t vehicle) const;
    /// Open doors, as gaps in its sides. @param corner from places relative to its middle and half sizes
    template <class Corner>
    void drawDoors(cairo_t* context, const PlateView& view, std::uint32_t frame, std::size_t vehicle,
                   Corner corner) const;

    const io::Bake& bake_;
    std::vector<float> track_, doors_;
};

}  // namespace throng::analysis
