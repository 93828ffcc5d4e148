// SPDX-License-Identifier: Apache-2.0
#include "analysis/plot/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/plot/png.h"

namespace throng::analysis {

Scale::Scale(const std::vector<double>& values) {
    if (!values.empty()) {
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        low_ = *least;
        high_ = *most;
    }
    const double margin = high_ > low_ ? 0.05 * (high_ - low_) : 1.0;
    if (low_ < 0.0 || low_ > 0.5 * high_)
        low_ -= margin;
    else
        low_ = 0.0;
    high_ += margin;
}

std::vector<double> Scale::ticks() const {
    const double raw = (high_ - low_) / 6.0;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    double step = power;
    for (const double factor : {1.0, 2.0, 5.0, 10.0})
        if (power * factor <= raw * 1.5) step = power * factor;
    const auto first = static_cast<int>(std::ceil(low_ / step - 1e-9));
    const auto last = static_cast<int>(std::floor(high_ / step + 1e-9));
    std::vector<double> result;
    for (int i = first; i <= last; ++i)
        result.push_back(i * step);
    return result;
}

std::string tickText(double value) {
    if (value >= 1.0e9 || (value != 0.0 && std::abs(value) < 1.0e-3)) return fmt::format("{:.3g}", value);
    if (value < 1000 || value != std::floor(value)) return fmt::format("{:.6g}", value);
    std::string digits = fmt::format("{:.0f}", value);
    for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(static_cast<std::size_t>(at), ",");
    return digits;
}

Canvas::Canvas(int width, int height)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), cairo_surface_destroy),
      context_(cairo_create(surface_.get()), cairo_destroy) {
    cairo_set_source_rgb(context_.get(), 1, 1, 1);
    cairo_paint(context_.get());
}

void Canvas::text(double x, double y, double size, const std::string& what, double across, bool bold) const {
    cairo_t* c = get();
    cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c, size);
    cairo_text_extents_t extents;
    cairo_text_extents(c, what.c_str(), &extents);
    cairo_move_to(c, x - across * extents.x_advance, y);
    cairo_show_text(c, what.c_str());
}

void Canvas::write(const std::filesystem::path& path) const {
    writePng(surface_.get(), path);
}

}  // namespace throng::analysis
