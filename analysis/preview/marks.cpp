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
    const auto level = [](double part) { return static_cast<std::int32_t>(std::lround(255.0 * part)); };
    red_ = level(colour.red);
    green_ = level(colour.green);
    blue_ = level(colour.blue);
    weight_ = 256.0f * static_cast<float>(alpha);
}

/// @param cover tells how much of the pixel with this middle is the mark's, 0 to 1
template <class Cover>
void Marks::paint(glm::vec2 lower, glm::vec2 upper, const Cover& cover) {
    // Limits first: places far outside are no whole numbers of pixels.
    const glm::vec2 most(static_cast<float>(width_), static_cast<float>(height_));
    const glm::ivec2 first(glm::floor(glm::clamp(lower - kEdge, glm::vec2(0.0f), most)));
    const glm::ivec2 last(glm::ceil(glm::clamp(upper + kEdge, glm::vec2(0.0f), most)));
    for (int y = first.y; y < last.y; ++y) {
        auto* row = reinterpret_cast<std::uint32_t*>(pixels_ + std::ptrdiff_t{y} * stride_);
        for (int x = first.x; x < last.x; ++x) {
            const float covered =
                cover(glm::vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
            const auto weight = static_cast<std::int32_t>(weight_ * covered);
            if (weight == 0) continue;
            const auto pixel = static_cast<std::int32_t>(row[x]);
            const auto mixed = [weight](std::int32_t before, std::int32_t mark) {
                return before + (((mark - before) * weight + 128) >> 8);
            };
            row[x] = static_cast<std::uint32_t>(mixed((pixel >> 16) & 255, red_) << 16 |
                                                mixed((pixel >> 8) & 255, green_) << 8 |
                                                mixed(pixel & 255, blue_));
        }
    }
}

void Marks::line(glm::vec2 from, glm::vec2 to, float width) {
    const float length = glm::distance(from, to);
    if (!(length > kShortest)) return;
    const glm::vec2 along = (to - from) / length, across = leftOf(along), middle = 0.5f * (from + to);
    const float half_length = 0.5f * length, half_width = 0.5f * width;
    const glm::vec2 reach = half_length * glm::abs(along) + half_width * glm::abs(across);
    paint(middle - reach, middle + reach, [=](glm::vec2 at) {
        const glm::vec2 off = at - middle;
        return coverOfStrip(half_width, glm::dot(off, across)) *
               coverOfStrip(half_length, glm::dot(off, along));
    });
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
