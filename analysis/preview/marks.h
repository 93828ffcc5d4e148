// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo.h>

#include <cstdint>
#include <glm/vec2.hpp>

#include "base/palette.h"

namespace throng::analysis {

/// The small marks of a plate, of which a film has hundreds of thousands a frame: with smooth edges, but
/// without what it takes to set up a general path for each. Where it ends, marks are cut off.
class Marks {
  public:
    /// @param surface CAIRO_FORMAT_RGB24; nothing else draws on it while this lives
    explicit Marks(cairo_surface_t* surface);
    ~Marks();
    Marks(const Marks&) = delete;
    Marks& operator=(const Marks&) = delete;

    /// All that is drawn from now on. @param alpha 0 to 1
    void use(Colour colour, double alpha);

    /// px; its ends are straight across, so that those that go on from each other do not lie on each other.
    void line(glm::vec2 from, glm::vec2 to, float width);
    void disc(glm::vec2 middle, float radius);
    /// All that is within `radius` of a line between two points.
    void capsule(glm::vec2 from, glm::vec2 to, float radius);
    void triangle(glm::vec2 a, glm::vec2 b, glm::vec2 c);

  private:
    static glm::ivec2 range(float from, float to, int count);
    template <class Cover>
    void paintRow(int y, int first, int last, const Cover& cover);
    template <class Cover>
    void paint(glm::vec2 lower, glm::vec2 upper, const Cover& cover);

    cairo_surface_t* surface_;
    std::uint8_t* pixels_;
    int width_, height_, stride_;
    std::uint32_t colour_ = 0;  // 0xRRGGBB
    float weight_ = 0.0f;       // of 256
};

}  // namespace throng::analysis
