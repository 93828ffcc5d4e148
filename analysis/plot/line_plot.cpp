// SPDX-License-Identifier: Apache-2.0
#include "analysis/plot/line_plot.h"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "analysis/plot/png.h"
#include "base/files/errors.h"

namespace throng::analysis {
namespace {

struct Colour {
    double r, g, b;
};

/// Told apart by those who do not see red or green, too (after Okabe and Ito 2008).
constexpr std::array kColours = {Colour{0.00, 0.45, 0.70}, Colour{0.84, 0.37, 0.00}, Colour{0.00, 0.62, 0.45},
                                 Colour{0.80, 0.47, 0.65}};

constexpr int kWidth = 1200, kHeight = 760;  // px
constexpr double kLeft = 86, kRight = 210, kTop = 74, kBottom = 64;

bool isShown(glm::dvec2 point) {
    return std::isfinite(point.x) && std::isfinite(point.y);
}

/// One axis: from values to positions between 0 and 1.
class Scale {
  public:
    explicit Scale(const std::vector<double>& values) {
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
    double at(double value) const { return (value - low_) / (high_ - low_); }
    std::vector<double> ticks() const {
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

  private:
    double low_ = 0.0, high_ = 10.0;
};

class Canvas {
  public:
    Canvas(int width, int height)
        : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), cairo_surface_destroy),
          context_(cairo_create(surface_.get()), cairo_destroy) {
        cairo_set_source_rgb(context_.get(), 1, 1, 1);
        cairo_paint(context_.get());
    }
    cairo_t* get() const { return context_.get(); }

    /// @param across where `x` is in the text: 0 at its left end, 1 at its right
    void text(double x, double y, double size, const std::string& what, double across = 0.0,
              bool bold = false) const {
        cairo_t* c = get();
        cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                               bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
        cairo_set_font_size(c, size);
        cairo_text_extents_t extents;
        cairo_text_extents(c, what.c_str(), &extents);
        cairo_move_to(c, x - across * extents.x_advance, y);
        cairo_show_text(c, what.c_str());
    }
    void write(const std::filesystem::path& path) const { writePng(surface_.get(), path); }

  private:
    std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
    std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context_;
};

std::string tickText(double value) {
    if (value >= 1.0e9 || (value != 0.0 && std::abs(value) < 1.0e-3)) return fmt::format("{:.3g}", value);
    if (value < 1000 || value != std::floor(value)) return fmt::format("{:.6g}", value);
    std::string digits = fmt::format("{:.0f}", value);
    for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(static_cast<std::size_t>(at), ",");
    return digits;
}

std::vector<double> shownValues(const LinePlot& plot, double glm::dvec2::*coordinate) {
    std::vector<double> values;
    for (const PlotSeries& series : plot.series)
        for (const glm::dvec2 point : series.points)
            if (isShown(point)) values.push_back(point.*coordinate);
    return values;
}

/// Where a name stands, so that names keep apart.
struct Label {
    std::size_t series;
    double y;
};

void spread(std::vector<Label>& labels, double least_gap) {
    std::sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.y < b.y; });
    for (int round = 0; round < 200; ++round)
        for (std::size_t i = 1; i < labels.size(); ++i) {
            const double lack = least_gap - (labels[i].y - labels[i - 1].y);
            if (lack <= 0.0) continue;
            labels[i - 1].y -= 0.5 * lack;
            labels[i].y += 0.5 * lack;
        }
}

class Drawing {
  public:
    explicit Drawing(const LinePlot& plot)
        : plot_(plot),
          canvas_(kWidth, kHeight),
          x_(shownValues(plot, &glm::dvec2::x)),
          y_(shownValues(plot, &glm::dvec2::y)) {}

    void draw() {
        grid();
        std::vector<Label> labels;
        for (std::size_t i = 0; i < plot_.series.size(); ++i)
            line(i, labels);
        spread(labels, 19.0);
        for (const Label& label : labels) {
            colour(label.series);
            canvas_.text(kWidth - kRight + 12, label.y + 5, 14, plot_.series[label.series].name);
        }
        cairo_set_source_rgb(canvas_.get(), 0.1, 0.1, 0.1);
        canvas_.text(kLeft, 32, 19, plot_.title, 0.0, true);
        cairo_set_source_rgb(canvas_.get(), 0.35, 0.35, 0.35);
        canvas_.text(kLeft, 55, 13, plot_.note);
    }
    const Canvas& canvas() const { return canvas_; }

  private:
    glm::dvec2 place(glm::dvec2 point) const {
        return {kLeft + x_.at(point.x) * (kWidth - kLeft - kRight),
                kHeight - kBottom - y_.at(point.y) * (kHeight - kTop - kBottom)};
    }
    void colour(std::size_t index) const {
        const Colour& c = kColours[index % kColours.size()];
        cairo_set_source_rgb(canvas_.get(), c.r, c.g, c.b);
    }
    void rule(double x0, double y0, double x1, double y1) const {
        cairo_move_to(canvas_.get(), x0, y0);
        cairo_line_to(canvas_.get(), x1, y1);
        cairo_stroke(canvas_.get());
    }
    void grid() const {
        cairo_t* c = canvas_.get();
        const double right = kWidth - kRight, bottom = kHeight - kBottom;
        cairo_set_line_width(c, 1.0);
        for (const double tick : x_.ticks()) {
            const double x = kLeft + x_.at(tick) * (right - kLeft);
            cairo_set_source_rgb(c, 0.9, 0.9, 0.9);
            rule(x, kTop, x, bottom);
            cairo_set_source_rgb(c, 0.25, 0.25, 0.25);
            canvas_.text(x, bottom + 20, 13, tickText(tick), 0.5);
        }
        for (const double tick : y_.ticks()) {
            const double y = bottom - y_.at(tick) * (bottom - kTop);
            cairo_set_source_rgb(c, 0.9, 0.9, 0.9);
            rule(kLeft, y, right, y);
            cairo_set_source_rgb(c, 0.25, 0.25, 0.25);
            canvas_.text(kLeft - 10, y + 5, 13, tickText(tick), 1.0);
        }
        cairo_set_source_rgb(c, 0.25, 0.25, 0.25);
        rule(kLeft, bottom, right, bottom);
        rule(kLeft, kTop, kLeft, bottom);
        canvas_.text(0.5 * (kLeft + right), bottom + 46, 14, plot_.x, 0.5);
        cairo_save(c);
        cairo_translate(c, 22, 0.5 * (kTop + bottom));
        cairo_rotate(c, -1.5707963);
        canvas_.text(0, 0, 14, plot_.y, 0.5);
        cairo_restore(c);
    }
    void line(std::size_t index, std::vector<Label>& labels) const {
        const PlotSeries& series = plot_.series[index];
        cairo_t* c = canvas_.get();
        colour(index);
        cairo_set_line_width(c, 2.2);
        const double dashes[] = {7.0, 5.0};
        cairo_set_dash(c, dashes, series.dashed ? 2 : 0, 0);
        cairo_save(c);
        cairo_rectangle(c, kLeft, kTop, kWidth - kLeft - kRight, kHeight - kTop - kBottom);
        cairo_clip(c);
        std::vector<glm::dvec2> places;
        for (const glm::dvec2 point : series.points)
            if (isShown(point)) places.push_back(place(point));
        for (const glm::dvec2 at : places)
            cairo_line_to(c, at.x, at.y);
        cairo_stroke(c);
        cairo_set_dash(c, dashes, 0, 0);
        cairo_restore(c);
        if (series.markers)
            for (const glm::dvec2 at : places) {
                cairo_arc(c, at.x, at.y, 4.0, 0.0, 6.2831853);
                cairo_fill(c);
            }
        if (!places.empty() && !series.name.empty()) labels.push_back({index, places.back().y});
    }

    const LinePlot& plot_;
    Canvas canvas_;
    Scale x_, y_;
};

}  // namespace

void writeLinePlot(const std::filesystem::path& path, const LinePlot& plot) {
    Drawing drawing(plot);
    drawing.draw();
    drawing.canvas().write(path);
}

}  // namespace throng::analysis
