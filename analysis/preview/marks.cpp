// SPDX-License-Identifier: Apache-2.0
#include "analysis/preview/marks.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace throng::analysis {
namespace {

constexpr float kShortest = 1.0f / 512.0f;  // px: shorter lines leave no trace
constexpr float kEdge = 0.5f;  // px: how far from a mark a pixel's middle may be, and it still has some of it

/// How much of a pixel is on the inner side of an edge. @param inside px, from the edge to its middle
float coverAt(float inside) {
    return std::clamp(inside + kEdge, 0.0f, 1.0f);
}

/// How much of a pixel a strip covers, both taken as they are across it. @param off px, between their middles
float coverOfStrip(float half, float off) {
    return std::max(std::min(half, off + kEdge) - std::max(-half, off - kEdge), 0.0f);
}

glm::vec2 leftOf(glm::vec2 way) {
    return {-way.y, way.x};
}

}  // namespace

Marks::Marks(cairo_surface_t* surface)
    : surface_(surface),
      width_(cairo_image_surface_get_width(surface)),
      height_(cairo_image_surface_get_height(surface)),
      stride_(cairo_image_surface_get_stride(surface)) {
    cairo_surface_flush(surface);
    pixels_ = cairo_image_surface_get_data(surface);
}

Marks::~Marks() {
    cairo_surface_mark_dirty(surface_);
}

void Marks::use(Colour colour, double alpha) {
    const auto level = [](double part) { return static_cast<std::uint32_t>(std::lround(255.0 * part)); };
    colour_ = level(colour.red) << 16 | level(colour.green) << 8 | level(colour.blue);
    weight_ = 256.0f * static_cast<float>(alpha);
}

/// A row's pixels [first, last).
/// @param cover tells how much of the pixel with this middle is the mark's, 0 to 1
template <class Cover>
void Marks::paintRow(int y, int first, int last, const Cover& cover) {
    auto* row = reinterpret_cast<std::uint32_t*>(pixels_ + std::ptrdiff_t{y} * stride_);
    for (int x = first; x < last; ++x) {
        const float covered = cover(glm::vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
        const auto weight = static_cast<std::uint32_t>(weight_ * covered);
        if (weight == 0) continue;
        // Red and blue are worked out in one number, green in another: their products do not reach each
        // other.
        constexpr std::uint32_t kRedAndBlue = 0xff00ffu, kGreen = 0x00ff00u;
        constexpr std::uint32_t kHalves = 0x800080u, kHalf = 0x8000u;
        const std::uint32_t red_and_blue =
            (row[x] & kRedAndBlue) * (256u - weight) + (colour_ & kRedAndBlue) * weight + kHalves;
        const std::uint32_t green = (row[x] & kGreen) * (256u - weight) + (colour_ & kGreen) * weight + kHalf;
        row[x] = (red_and_blue >> 8 & kRedAndBlue) | (green >> 8 & kGreen);
    }
}

/// The whole pixels between two places, of as many as there are.
glm::ivec2 Marks::range(float from, float to, int count) {
    // Limits first: places far outside, and what is no number, are no whole numbers of pixels. Above zero,
    // what is cut off is what is rounded down.
    const auto limited = [&](float at) { return std::min(std::max(0.0f, at), static_cast<float>(count)); };
    const float last = limited(to + kEdge);
    const int whole = static_cast<int>(last);
    return {static_cast<int>(limited(from - kEdge)), whole + (static_cast<float>(whole) < last ? 1 : 0)};
}

template <class Cover>
void Marks::paint(glm::vec2 lower, glm::vec2 upper, const Cover& cover) {
    const glm::ivec2 columns = range(lower.x, upper.x, width_), rows = range(lower.y, upper.y, height_);
    for (int y = rows.x; y < rows.y; ++y)
        paintRow(y, columns.x, columns.y, cover);
}

void Marks::line(glm::vec2 from, glm::vec2 to, float width) {
    const float length = glm::distance(from, to);
    if (!(length > kShortest)) return;
    const glm::vec2 along = (to - from) / length, across = leftOf(along), middle = 0.5f * (from + to);
    const float half_length = 0.5f * length, half_width = 0.5f * width;
    const glm::vec2 reach = half_length * glm::abs(along) + half_width * glm::abs(across);
    const glm::ivec2 rows = range(middle.y - reach.y, middle.y + reach.y, height_);
    // Of a row, only what is between both long sides is looked at: of lines aslant, boxes are mostly empty.
    constexpr float kLevel = 1.0e-3f;
    const float slope = std::abs(across.x) > kLevel ? -across.y / across.x : 0.0f;
    const float aside = std::abs(across.x) > kLevel ? (half_width + kEdge) / std::abs(across.x) : reach.x;
    for (int y = rows.x; y < rows.y; ++y) {
        const float at = middle.x + slope * (static_cast<float>(y) + 0.5f - middle.y);
        const glm::ivec2 columns =
            range(std::max(at - aside, middle.x - reach.x), std::min(at + aside, middle.x + reach.x), width_);
        paintRow(y, columns.x, columns.y, [=](glm::vec2 pixel) {
            const glm::vec2 off = pixel - middle;
            return coverOfStrip(half_width, glm::dot(off, across)) *
                   coverOfStrip(half_length, glm::dot(off, along));
        });
    }
}

void Marks::disc(glm::vec2 middle, float radius) {
    paint(middle - radius, middle + radius,
          [=](glm::vec2 at) { return coverAt(radius - glm::distance(at, middle)); });
}

void Marks::capsule(glm::vec2 from, glm::vec2 to, float radius) {
    const glm::vec2 way = to - from;
    const float squared = std::max(glm::dot(way, way), 1.0e-12f);
    paint(glm::min(from, to) - radius, glm::max(from, to) + radius, [=](glm::vec2 at) {
        const float share = std::clamp(glm::dot(at - from, way) / squared, 0.0f, 1.0f);
        return coverAt(radius - glm::distance(at, from + share * way));
    });
}

void Marks::triangle(glm::vec2 a, glm::vec2 b, glm::vec2 c) {
    const glm::vec2 corners[] = {a, b, c};
    glm::vec2 inwards[3];
    const glm::vec2 ab = b - a, ac = c - a;
    const float turn = ab.x * ac.y - ab.y * ac.x < 0.0f ? -1.0f : 1.0f;
    for (int i = 0; i < 3; ++i) {
        const glm::vec2 edge = corners[(i + 1) % 3] - corners[i];
        const float length = glm::length(edge);
        if (!(length > 0.0f)) return;
        inwards[i] = turn / length * leftOf(edge);
    }
    paint(glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c), [&](glm::vec2 at) {
        float covered = 1.0f;
        for (int i = 0; i < 3; ++i)
            covered *= coverAt(glm::dot(at - corners[i], inwards[i]));
        return covered;
    });
}

}  // namespace throng::analysis
