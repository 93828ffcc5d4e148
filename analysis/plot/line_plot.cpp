// SPDX-License-Identifier: Apache-2.0
#include "analysis/plot/line_plot.h"

#include <algorithm>
#include <cmath>

#include "analysis/plot/canvas.h"

namespace throng::analysis {
namespace {

constexpr int kWidth = 1200, kHeight = 760;  // px
constexpr double kLeft = 86, kRight = 210, kTop = 74, kBottom = 64;

bool isShown(glm::dvec2 point) {
    return std::isfinite(point.x) && std::isfinite(point.y);
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
    void colour(std::size_t index) const { canvas_.use(kPlotColours[index % kPlotColours.size()]); }
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
