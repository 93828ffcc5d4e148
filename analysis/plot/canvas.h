// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/palette.h"

namespace throng::analysis {

/// Told apart by those who do not see red or green, too (after Okabe and Ito 2008).
inline constexpr std::array kPlotColours = {Colour{0.00, 0.45, 0.70}, Colour{0.84, 0.37, 0.00},
                                            Colour{0.00, 0.62, 0.45}, Colour{0.80, 0.47, 0.65}};

/// One axis: from values to positions between 0 and 1.
class Scale {
  public:
    /// Holds all the values and some room.
    explicit Scale(const std::vector<double>& values);
    /// Exactly from `low` to `high`.
    Scale(double low, double high) : low_(low), high_(high > low ? high : low + 1.0) {}
    double at(double value) const { return (value - low_) / (high_ - low_); }
    std::vector<double> ticks() const;

  private:
    double low_ = 0.0, high_ = 10.0;
};

std::string tickText(double value);

/// A white picture to draw on.
class Canvas {
  public:
    Canvas(int width, int height);
    cairo_t* get() const { return context_.get(); }

    void use(const Colour& colour) const {
        cairo_set_source_rgb(get(), colour.red, colour.green, colour.blue);
    }
    /// @param across where `x` is in the text: 0 at its left end, 1 at its right
    void text(double x, double y, double size, const std::string& what, double across = 0.0,
              bool bold = false) const;
    /// @throws OutputError
    void write(const std::filesystem::path& path) const;

  private:
    std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
    std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context_;
};

}  // namespace throng::analysis
