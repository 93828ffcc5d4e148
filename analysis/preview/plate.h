// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo.h>

#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/preview/preview.h"
#include "analysis/preview/traffic_layer.h"
#include "base/capsule.h"
#include "base/palette.h"
#include "io/crowd_reader.h"
#include "io/storeys.h"

namespace throng::analysis {

class Marks;

struct SurfaceFree {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using Surface = std::unique_ptr<cairo_surface_t, SurfaceFree>;

/// Draws frames of one bake. What does not move is drawn once; what changes slowly, some times a second.
class Plate {
  public:
    Plate(const std::filesystem::path& bake, const PreviewOptions& options);

    std::uint32_t frames() const { return bake_.frames; }
    double fps() const { return bake_.fps; }
    int width() const { return width_; }
    int height() const { return height_; }

    /// The frame with the most people (looked for in steps of a second).
    std::uint32_t busiestFrame();

    /// For draw(): as large as the plate.
    Surface makeCanvas() const;
    void draw(std::uint32_t frame, cairo_surface_t* canvas);

  private:
    glm::dvec2 toPixel(double x, double y) const;
    void chooseLevel();
    bool isShown(std::size_t level) const { return !level_ || *level_ == level; }
    bool isShown(const io::CrowdFrame& frame, std::size_t row) const;
    std::size_t nearestFloor(double height) const;
    bool isWallShown(std::size_t wall) const;
    void drawLayout();
    void drawFloors(cairo_t* context) const;
    void drawWall(cairo_t* context, const authoring::Wall& wall) const;
    void drawGates(cairo_t* context, std::uint32_t frame) const;
    void drawDensity(cairo_t* context, const io::CrowdFrame& now) const;
    std::uint32_t framesOfPiece(std::uint32_t length) const;
    void drawTrails(cairo_surface_t* canvas, const io::CrowdFrame& now);
    void drawPieces(cairo_surface_t* canvas, const io::CrowdFrame& earlier, const io::CrowdFrame& later,
                    double strength) const;
    io::CrowdFrame drawGround(const io::CrowdFrame& now);
    /// @returns how far it reaches ahead, px
    double drawBody(Marks& marks, glm::dvec2 at, const Capsule& body, double size) const;
    void drawPeople(cairo_surface_t* canvas, const io::CrowdFrame& now) const;
    void drawCaption(cairo_t* context, const io::CrowdFrame& now) const;
    void drawLegend(cairo_t* context) const;
    void drawScaleBar(cairo_t* context) const;
    /// px, even: video encoders want that.
    int widthFor(glm::dvec2 extent) const;
    void placeLegend();
    PlateView view() const;
    void path(cairo_t* context, const std::vector<glm::dvec2>& points, bool close) const;
    void text(cairo_t* context, double x, double y, double size, const std::string& what,
              bool bold = false) const;

    io::CrowdReader crowd_;
    const io::Bake& bake_;
    TrafficLayer traffic_;
    io::Storeys storeys_;
    const std::vector<io::AgentRow>& people_;
    io::GroupTable groups_;
    PreviewOptions options_;
    std::optional<std::size_t> level_;  // the only one shown
    /// Where a group's colour and name stand, px from the legend's left and upper corner.
    struct LegendEntry {
        std::string name;
        double x = 0.0;
        int line = 0;
    };
    std::vector<LegendEntry> legend_;  // by group
    int legend_lines_ = 1;
    std::size_t left_out_ = 0;  // groups, where there are thousands
    int width_ = 0, height_ = 0;
    double scale_ = 1.0;  // px per m
    Surface layout_, ground_;
    std::optional<std::uint32_t> ground_frame_;
};

}  // namespace throng::analysis
