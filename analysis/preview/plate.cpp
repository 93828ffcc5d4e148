// SPDX-License-Identifier: Apache-2.0
#include "analysis/preview/plate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numbers>

#include "analysis/preview/colour.h"
#include "analysis/preview/marks.h"
#include "base/activities.h"
#include "base/text/printable.h"

namespace throng::analysis {
namespace {

constexpr double kMargin = 28.0;      // px
constexpr double kHeader = 64.0;      // px, above the drawing
constexpr double kFooter = 58.0;      // px, below it, with a legend of one line
constexpr double kLegendLine = 18.0;  // px
constexpr int kMostLegendLines = 60;  // more are no picture
constexpr double kLegendSize = 12.0;  // px, of its letters
constexpr double kDensityCell = 1.0;  // m
constexpr double kTallest = 32767.0;  // px that Cairo can draw
constexpr double kMostCells = 4.0e6;  // of the density layer
constexpr double kHalfStorey = 1.6;   // m: who is nowhere is drawn with a level that is so near in height
constexpr double kMostDensity = 3.0;  // persons per m^2 at the warm end of the scale
constexpr Colour kPaper = colourFromHex(0xf6f4ef), kInk = colourFromHex(0x22252b),
                 kRoad = colourFromHex(0xe2dfd6), kArea = colourFromHex(0xece6d3),
                 kAvoided = colourFromHex(0xcfdcc0), kSlow = colourFromHex(0xd9d3df),
                 kRoomy = colourFromHex(0xcadbe6), kWall = colourFromHex(0x3d424c),
                 kSolid = colourFromHex(0xc9c6be);

/// From paper through yellow to red, transparent where nobody is.
void setHeat(cairo_t* context, double share) {
    const double t = std::clamp(share, 0.0, 1.0);
    cairo_set_source_rgba(context, 0.98 - 0.12 * t, 0.80 - 0.66 * t, 0.36 - 0.24 * t,
                          std::min(0.85, 1.3 * t));
}

struct Context {
    explicit Context(cairo_surface_t* surface) : context(cairo_create(surface)) {}
    ~Context() { cairo_destroy(context); }
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    cairo_t* context;
};

std::uint32_t presentIn(const io::CrowdFrame& frame) {
    std::uint32_t present = 0;
    for (std::size_t row = 0; row < frame.rows(); ++row)
        present += frame.isThere(row);
    return present;
}

std::uint32_t trailFrames(const io::Bake& bake, const PreviewOptions& options) {
    return static_cast<std::uint32_t>(options.trail_seconds * bake.fps);
}

/// A film needs a frame for as long as trails are; of large crowds, no more than memory is worth.
std::size_t framesToKeep(const io::Bake& bake, const PreviewOptions& options) {
    constexpr std::size_t kMostBytes = std::size_t{256} << 20, kStreamsDrawn = 3;
    const std::size_t bytes = (bake.agents + std::size_t{1}) * kStreamsDrawn * kComponents * sizeof(float);
    return std::min<std::size_t>(trailFrames(bake, options) + 1, kMostBytes / bytes);
}

bool isInside(char byte) {  // of a letter of several bytes
    return (static_cast<unsigned char>(byte) & 0xc0u) == 0x80u;
}

std::size_t lettersOf(const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count_if(text, [](char byte) { return !isInside(byte); }));
}

std::string firstLetters(const std::string& text, std::size_t count) {
    std::size_t end = 0;
    for (; end < text.size() && (count > 0 || isInside(text[end])); ++end)
        if (!isInside(text[end])) --count;
    return text.substr(0, end);
}

/// How strongly somebody is drawn: who sits in a seat is pale, who stands before it is not.
double strengthOf(const io::CrowdFrame& now, std::size_t row) {
    constexpr double kSits = 0.45, kClaps = 0.7;
    if (!hasSeat(now.activity(row))) return 1.0;
    const auto activity = static_cast<ActivityCode>(static_cast<int>(now.activity(row)));
    if (activity == ActivityCode::sits) return kSits;
    if (activity == ActivityCode::readies || activity == ActivityCode::claps) return kClaps;
    if (activity != ActivityCode::rises && activity != ActivityCode::settles) return 1.0;
    const double phase = now[Stream::state][row * kComponents + 2];
    const double up = 1.0 - std::abs(2.0 * (phase - std::floor(phase)) - 1.0);
    return kSits + (1.0 - kSits) * up;
}

}  // namespace

Plate::Plate(const std::filesystem::path& bake, const PreviewOptions& options)
    : crowd_(io::loadBake(bake)),
      bake_(crowd_.bake()),
      traffic_(bake_),
      storeys_(bake_),
      people_(crowd_.people()),
      groups_(io::groupsOf(people_)),
      options_(options) {
    crowd_.keep(framesToKeep(bake_, options));
    const glm::dvec2 extent = bake_.maximum - bake_.minimum;
    if (bake_.frames == 0) throw InputError(bake, "has no frames: there is nothing to draw");
    chooseLevel();
    width_ = widthFor(extent);
    scale_ = (width_ - 2.0 * kMargin) / std::max(extent.x, 1.0);
    placeLegend();
    const double height =
        std::ceil(extent.y * scale_ + kHeader + kFooter + kLegendLine * (legend_lines_ - 1));
    if (height > kTallest)
        throw InputError(bake,
                         fmt::format("its site is {:.6g} m wide and {:.6g} m high: no picture is so narrow",
                                     extent.x, extent.y));
    height_ = static_cast<int>(height) / 2 * 2;
    layout_ = makeCanvas();
    drawLayout();
    ground_ = makeCanvas();
}

Surface Plate::makeCanvas() const {
    Surface canvas(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_, height_));
    if (cairo_surface_status(canvas.get()) != CAIRO_STATUS_SUCCESS)
        throw InputError(
            bake_.folder,
            fmt::format("a picture of {} x {} px is more than can be drawn: ask for a smaller --width",
                        width_, height_));
    return canvas;
}

int Plate::widthFor(glm::dvec2 extent) const {
    constexpr double kNarrowest = 640.0;  // px: captions have room
    double width = options_.width;
    if (options_.height > 0) {
        const double room = options_.height - kHeader - kFooter;
        const double fits = room / std::max(extent.y, 1.0) * std::max(extent.x, 1.0) + 2.0 * kMargin;
        width = std::min(width, std::max(fits, kNarrowest));
    }
    return static_cast<int>(width) / 2 * 2;
}

/// All groups have their place in the legend, in as many lines as it takes; beside the last one is the scale
/// bar.
void Plate::placeLegend() {
    constexpr double kDot = 15.0, kGap = 19.0;  // px, before and after a name
    const Surface page(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
    const Context scope(page.get());
    cairo_select_font_face(scope.context, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(scope.context, kLegendSize);
    const auto widthOf = [&](const std::string& name) {
        cairo_text_extents_t extents;
        cairo_text_extents(scope.context, name.c_str(), &extents);
        return extents.x_advance;
    };
    const double most = 0.6 * width_ - kMargin;  // the scale bar and its caption are right of it
    double x = 0.0;
    for (const std::string& group : groups_.names) {
        std::string name = printable(group);
        while (lettersOf(name) > 8 && kDot + widthOf(name) > most)  // a name that no line holds is cut
            name = firstLetters(name, 3 * lettersOf(name) / 4) + "…";
        const double width = kDot + widthOf(name) + kGap;
        if (x > 0.0 && x + width - kGap > most) {
            x = 0.0;
            if (legend_lines_ == kMostLegendLines) {
                left_out_ = groups_.names.size() - legend_.size();
                break;
            }
            ++legend_lines_;
        }
        legend_.push_back({name, x, legend_lines_ - 1});
        x += width;
    }
}

glm::dvec2 Plate::toPixel(double x, double y) const {
    return {kMargin + (x - bake_.minimum.x) * scale_, kHeader + (bake_.maximum.y - y) * scale_};
}

PlateView Plate::view() const {
    return {kMargin, kHeader, bake_.minimum, bake_.maximum, scale_};
}

void Plate::path(cairo_t* context, const std::vector<glm::dvec2>& points, bool close) const {
    cairo_new_path(context);
    for (const glm::dvec2 point : points) {
        const glm::dvec2 at = toPixel(point.x, point.y);
        cairo_line_to(context, at.x, at.y);
    }
    if (close) cairo_close_path(context);
}

void Plate::text(cairo_t* context, double x, double y, double size, const std::string& what,
                 bool bold) const {
    cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context, size);
    cairo_move_to(context, x, y);
    cairo_show_text(context, what.c_str());
}

void Plate::drawLayout() {
    const Context scope(layout_.get());
    cairo_t* context = scope.context;
    setColour(context, kPaper);
    cairo_paint(context);
    drawFloors(context);
    for (const authoring::Road& road : bake_.roads) {
        if (!isShown(road.level)) continue;
        path(context, road.centreline, false);
        cairo_set_line_width(context, road.width * scale_);
        cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
        setColour(context, kRoad);
        cairo_stroke(context);
    }
    for (const authoring::Area& area : bake_.areas) {
        if (!isShown(area.level)) continue;
        path(context, area.polygon, true);
        setColour(context, kArea);
        cairo_fill(context);
    }
    for (const authoring::Patch& patch : bake_.patches) {
        if (!isShown(patch.level)) continue;
        path(context, patch.polygon, true);
        setColour(context, patch.pace != 1.0 ? kSlow : patch.cost > 1.0 ? kAvoided : kRoomy);
        cairo_fill(context);
    }
    traffic_.drawStreet(context, view());
    for (std::size_t i = 0; i < bake_.walls.size(); ++i)
        if (bake_.walls[i].toggles.empty() && isWallShown(i)) drawWall(context, bake_.walls[i]);
    setColour(context, kInk);
    text(context, kMargin, 38.0, 22.0, bake_.name, true);
    drawScaleBar(context);
    drawLegend(context);
}

/// Floors above each other get lighter towards the top.
void Plate::drawFloors(cairo_t* context) const {
    for (std::size_t i = 0; i < bake_.levels.size(); ++i) {
        const bool is_landing = bake_.levels[i].is_landing;
        if (!isShown(is_landing ? nearestFloor(bake_.levels[i].height) : i)) continue;
        path(context, bake_.levels[i].floor, true);
        setColour(context, kRoad, 0.45);
        cairo_fill(context);
    }
}

/// Who is on a floor is drawn with that one only; who is on a link, with the end that is nearer.
bool Plate::isShown(const io::CrowdFrame& frame, std::size_t row) const {
    if (!frame.isThere(row)) return false;
    if (!level_) return true;
    const double height = frame.height(row);
    const auto apart = [&](std::size_t level) { return std::abs(height - bake_.levels[level].height); };
    const auto level = storeys_.levelAt(frame.place(row), height);
    if (level && !bake_.levels[*level].is_landing) return *level == *level_;
    const auto link = level ? std::nullopt : storeys_.linkAt(frame.place(row), height);
    if (!link && !level) return apart(*level_) < kHalfStorey;
    if (level || bake_.levels[bake_.links[*link].from].is_landing ||
        bake_.levels[bake_.links[*link].to].is_landing)
        return *level_ == nearestFloor(height);
    const std::size_t from = bake_.links[*link].from, to = bake_.links[*link].to;
    return (*level_ == from || *level_ == to) && apart(*level_) <= std::min(apart(from), apart(to));
}

/// Of those that are no landings.
std::size_t Plate::nearestFloor(double height) const {
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < bake_.levels.size(); ++i)
        if (const double apart = std::abs(height - bake_.levels[i].height);
            !bake_.levels[i].is_landing && apart < least) {
            least = apart;
            nearest = i;
        }
    return nearest;
}

bool Plate::isWallShown(std::size_t wall) const {
    return !level_ || storeys_.isWallBeside(*level_, wall);
}

void Plate::chooseLevel() {
    if (options_.level.empty()) return;
    const auto known = std::ranges::find(bake_.levels, options_.level, &authoring::Level::id);
    if (known != bake_.levels.end() && !known->is_landing) {
        level_ = static_cast<std::size_t>(known - bake_.levels.begin());
        return;
    }
    std::vector<std::string> ids;
    for (const authoring::Level& level : bake_.levels)
        if (!level.is_landing) ids.push_back(fmt::format("`{}`", level.id));
    throw InputError(
        bake_.folder,
        ids.empty() ? fmt::format("has no level `{}`: its ground is one", options_.level)
                    : fmt::format("has no level `{}`: there are {}", options_.level, fmt::join(ids, ", ")));
}

void Plate::drawScaleBar(cairo_t* context) const {
    const double wanted = 0.16 * width_ / scale_;
    const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
    const double metres = wanted >= 5.0 * decade   ? 5.0 * decade
                          : wanted >= 2.0 * decade ? 2.0 * decade
                                                   : decade;
    const double right = width_ - kMargin, y = height_ - 24.0;
    setColour(context, kInk);
    cairo_set_line_width(context, 2.0);
    cairo_move_to(context, right - metres * scale_, y - 5.0);
    cairo_rel_line_to(context, 0.0, 5.0);
    cairo_rel_line_to(context, metres * scale_, 0.0);
    cairo_rel_line_to(context, 0.0, -5.0);
    cairo_stroke(context);
    text(context, right - metres * scale_, y - 10.0, 13.0, fmt::format("{:.4g} m", metres));
    if (!options_.density) return;
    const double left = right - metres * scale_ - 250.0;
    for (int i = 0; i < 120; ++i) {
        setHeat(context, i / 119.0);
        cairo_rectangle(context, left + i, y - 12.0, 1.5, 12.0);
        cairo_fill(context);
    }
    setColour(context, kInk);
    text(context, left, y - 17.0, 12.0, "persons per square metre");
    text(context, left, y + 14.0, 11.0, "0");
    text(context, left + 112.0, y + 14.0, 11.0, fmt::format("{:.0f}+", kMostDensity));
}

void Plate::drawDensity(cairo_t* context, const io::CrowdFrame& now) const {
    const glm::dvec2 extent = bake_.maximum - bake_.minimum;
    const double cell = std::max({kDensityCell, std::sqrt(extent.x * extent.y / kMostCells),
                                  4.0 * std::max(extent.x, extent.y) / kMostCells});
    const auto columns = static_cast<std::size_t>(std::ceil(extent.x / cell)) + 1;
    const auto rows = static_cast<std::size_t>(std::ceil(extent.y / cell)) + 1;
    // Everybody's mark is spread over the four nearest cells, and the cells over their neighbours: a smooth
    // layer.
    std::vector<double> density(columns * rows, 0.0), smooth(columns * rows, 0.0);
    for (std::size_t row = 0; row < bake_.agents; ++row) {
        if (!isShown(now, row)) continue;
        const glm::dvec2 at = glm::max((now.place(row) - bake_.minimum) / cell, glm::dvec2(0.0));
        if (at.x >= static_cast<double>(columns) || at.y >= static_cast<double>(rows)) continue;
        density[static_cast<std::size_t>(at.y) * columns + static_cast<std::size_t>(at.x)] +=
            1.0 / (cell * cell);
    }
    constexpr double kKernel[3] = {0.25, 0.5, 0.25};
    for (std::size_t y = 1; y + 1 < rows; ++y)
        for (std::size_t x = 1; x + 1 < columns; ++x)
            for (std::size_t j = 0; j < 3; ++j)
                for (std::size_t i = 0; i < 3; ++i)
                    smooth[y * columns + x] +=
                        kKernel[j] * kKernel[i] * density[(y + j - 1) * columns + x + i - 1];
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < columns; ++x) {
            const double here = smooth[y * columns + x];
            if (here < 0.15) continue;
            const glm::dvec2 at = toPixel(bake_.minimum.x + static_cast<double>(x) * cell,
                                          bake_.minimum.y + static_cast<double>(y + 1) * cell);
            setHeat(context, here / kMostDensity);
            cairo_rectangle(context, at.x, at.y, cell * scale_ + 0.5, cell * scale_ + 0.5);
            cairo_fill(context);
        }
}

/// Trails are of pieces, about as long as a few pixels for who walks: finer ones would not be seen.
std::uint32_t Plate::framesOfPiece(std::uint32_t length) const {
    constexpr double kPiece = 6.0, kWalks = 1.3;  // px, m/s
    const auto frames = static_cast<std::uint32_t>(kPiece / (kWalks * scale_) * bake_.fps);
    return std::max(std::clamp(frames, length / 24, std::max(length / 8, length / 24)), 1u);
}

void Plate::drawTrails(cairo_surface_t* canvas, const io::CrowdFrame& now) {
    const std::uint32_t length = trailFrames(bake_, options_);
    const std::uint32_t stride = framesOfPiece(length);
    if (length == 0) return;
    io::CrowdFrame later = now;
    for (std::uint32_t back = stride; back <= length && back <= now.index(); back += stride) {
        const io::CrowdFrame earlier = crowd_.frame(now.index() - back);
        drawPieces(canvas, earlier, later, 1.0 - static_cast<double>(back) / length);
        later = earlier;
    }
}

/// Of everybody's trail. @param strength 1: what was walked just now
void Plate::drawPieces(cairo_surface_t* canvas, const io::CrowdFrame& earlier, const io::CrowdFrame& later,
                       double strength) const {
    Marks marks(canvas);
    const auto width = static_cast<float>(std::max(1.0, 0.10 * scale_));
    for (std::size_t row = 0; row < bake_.agents; ++row) {
        if (!isShown(later, row) || !isShown(earlier, row)) continue;
        marks.use(groupColour(groups_.group_of[row]), 0.42 * strength);
        marks.line(toPixel(later.place(row).x, later.place(row).y),
                   toPixel(earlier.place(row).x, earlier.place(row).y), width);
    }
}

/// What lies under people, who move over it: it changes slowly, and a film's encoder has nothing to do where
/// it does not. @returns the frame of which it is, a few before at most
io::CrowdFrame Plate::drawGround(const io::CrowdFrame& now) {
    constexpr double kPerSecond = 6.0;  // trails of six seconds fade by 3 % from one to the next
    const auto every = std::max(1u, static_cast<std::uint32_t>(std::lround(bake_.fps / kPerSecond)));
    if (ground_frame_ && now.index() - *ground_frame_ < every) return crowd_.frame(*ground_frame_);
    ground_frame_ = now.index();
    const Context scope(ground_.get());
    cairo_set_source_surface(scope.context, layout_.get(), 0.0, 0.0);
    cairo_paint(scope.context);
    if (options_.density) drawDensity(scope.context, now);
    drawTrails(ground_.get(), now);
    return now;
}

void Plate::drawWall(cairo_t* context, const authoring::Wall& wall) const {
    path(context, wall.points, wall.closed);
    if (wall.closed) {
        setColour(context, kSolid);
        cairo_fill_preserve(context);
    }
    cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_width(context, wall.closed ? 2.0 : std::max(2.0, wall.thickness * scale_));
    setColour(context, kWall);
    cairo_stroke(context);
}

/// Gates that are closed; of open ones, the posts.
void Plate::drawGates(cairo_t* context, std::uint32_t frame) const {
    for (std::size_t i = 0; i < bake_.walls.size(); ++i) {
        const authoring::Wall& wall = bake_.walls[i];
        if (wall.toggles.empty() || !isWallShown(i)) continue;
        if (!wall.isOpen(frame / bake_.fps)) {
            drawWall(context, wall);
            continue;
        }
        setColour(context, kWall);
        for (const glm::dvec2 end : {wall.points.front(), wall.points.back()}) {
            const glm::dvec2 at = toPixel(end.x, end.y);
            cairo_arc(context, at.x, at.y, std::max(2.5, 0.75 * wall.thickness * scale_), 0.0,
                      2.0 * std::numbers::pi);
            cairo_fill(context);
        }
    }
}

/// Discs all alike, but for what the ground makes of them; bodies that are none as they are, from above.
double Plate::drawBody(Marks& marks, glm::dvec2 at, const Capsule& body, double size) const {
    if (body.axis == glm::dvec2(0.0)) {
        const double radius = std::max(1.6, 0.25 * size * scale_);
        marks.disc(at, static_cast<float>(radius));
        return radius;
    }
    const double thickness = std::max(1.6, body.thickness * scale_);
    const glm::dvec2 axis = scale_ * glm::dvec2(body.axis.x, -body.axis.y);
    marks.capsule(at - axis, at + axis, static_cast<float>(thickness));
    return thickness;
}

void Plate::drawPeople(cairo_surface_t* canvas, const io::CrowdFrame& now) const {
    constexpr Colour kNose = colourFromHex(0xffffff);
    Marks marks(canvas);
    for (std::size_t row = 0; row < bake_.agents; ++row) {
        if (!isShown(now, row)) continue;
        const glm::dvec2 at = toPixel(now.place(row).x, now.place(row).y);
        const glm::dvec2 ahead(now.facing(row).x, -now.facing(row).y), beside(-ahead.y, ahead.x);
        marks.use(groupColour(groups_.group_of[row]), strengthOf(now, row));
        const double radius = drawBody(marks, at, now.body(row, people_[row]), now.size(row));
        // A nose: a white wedge tells which way somebody looks.
        marks.use(kNose, 0.9);
        marks.triangle(at + ahead * radius, at + beside * (0.42 * radius), at - beside * (0.42 * radius));
    }
}

void Plate::drawCaption(cairo_t* context, const io::CrowdFrame& now) const {
    setColour(context, kInk, 0.75);
    text(context, kMargin, 56.0, 13.0,
         fmt::format("{:.2f} s, frame {} of {} at {:.4g} frames/s, {} people in the scene",
                     now.index() / bake_.fps, now.index() + 1, bake_.frames, bake_.fps, presentIn(now)));
}

/// What is said of the whole bake.
void Plate::drawLegend(cairo_t* context) const {
    setColour(context, kInk, 0.75);
    text(context, kMargin, height_ - 34.0 - kLegendLine * (legend_lines_ - 1), 13.0,
         fmt::format("whole bake: {} people, {} arrived, {} walking at the end, {} refused",
                     bake_.account.agents, bake_.account.arrived, bake_.account.walking,
                     bake_.account.refused) +
             (left_out_ ? fmt::format("; {} groups are not named here", left_out_) : ""));
    for (std::size_t group = 0; group < legend_.size(); ++group) {
        const LegendEntry& entry = legend_[group];
        const double x = kMargin + entry.x;
        const double y = height_ - 17.0 - kLegendLine * (legend_lines_ - 1 - entry.line);
        setColour(context, groupColour(group));
        cairo_arc(context, x + 5.0, y, 5.0, 0.0, 2.0 * std::numbers::pi);
        cairo_fill(context);
        setColour(context, kInk);
        text(context, x + 15.0, y + 4.0, kLegendSize, entry.name);
    }
}

std::uint32_t Plate::busiestFrame() {
    const auto stride = std::max(1u, static_cast<std::uint32_t>(bake_.fps));
    std::uint32_t best = 0, most = 0;
    for (std::uint32_t frame = 0; frame < bake_.frames; frame += stride) {
        const std::uint32_t present = presentIn(crowd_.frame(frame));
        if (present <= most) continue;
        most = present;
        best = frame;
    }
    return best;
}

void Plate::draw(std::uint32_t frame, cairo_surface_t* canvas) {
    const io::CrowdFrame now = crowd_.frame(frame), before = drawGround(now);
    const Context scope(canvas);
    cairo_t* context = scope.context;
    cairo_set_source_surface(context, ground_.get(), 0.0, 0.0);
    cairo_paint(context);
    if (options_.trail_seconds > 0.0) drawPieces(canvas, before, now, 1.0);
    drawGates(context, frame);
    traffic_.drawFrame(context, view(), frame);
    drawPeople(canvas, now);
    drawCaption(context, now);
    cairo_surface_flush(canvas);
}

}  // namespace throng::analysis
