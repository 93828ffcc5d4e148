// SPDX-License-Identifier: Apache-2.0
#include "analysis/preview/film_planes.h"

namespace throng::analysis {
namespace {

// Parts of a colour in 256ths, so that 16 bits hold all sums and a processor's vectors most of them at once:
// 219 of 255 steps are brightness (0.299 R + 0.587 G + 0.114 B), 224 are colour. Greys are exact, colours
// within a step.
constexpr int kBits = 8;
constexpr std::uint16_t kYRed = 66, kYGreen = 129, kYBlue = 25, kYZero = (16 << kBits) + 128;
constexpr std::uint16_t kURed = 38, kUGreen = 74, kUBlue = 112, kVRed = 112, kVGreen = 94, kVBlue = 18;
constexpr std::uint16_t kColourZero = (128 << kBits) + 128;

std::uint16_t red(std::uint32_t pixel) {
    return static_cast<std::uint16_t>((pixel >> 16) & 255u);
}
std::uint16_t green(std::uint32_t pixel) {
    return static_cast<std::uint16_t>((pixel >> 8) & 255u);
}
std::uint16_t blue(std::uint32_t pixel) {
    return static_cast<std::uint16_t>(pixel & 255u);
}

std::uint8_t top(int sum) {
    return static_cast<std::uint8_t>(static_cast<std::uint16_t>(sum) >> kBits);
}

// A film's frames are converted whole: where a processor has wider vectors than all have, they are used.
#if defined(__x86_64__)
#define THRONG_WIDE_VECTORS __attribute__((target_clones("avx2", "default")))
#else
#define THRONG_WIDE_VECTORS
#endif

THRONG_WIDE_VECTORS void brightnessOf(const std::uint32_t* row, std::size_t width, std::uint8_t* to) {
    for (std::size_t x = 0; x < width; ++x)
        to[x] = top(kYRed * red(row[x]) + kYGreen * green(row[x]) + kYBlue * blue(row[x]) + kYZero);
}

/// Of four pixels each.
THRONG_WIDE_VECTORS void coloursOf(const std::uint32_t* upper, const std::uint32_t* lower, std::size_t pairs,
                                   std::uint8_t* u, std::uint8_t* v) {
    for (std::size_t i = 0; i < pairs; ++i) {
        const std::uint32_t a = upper[2 * i], b = upper[2 * i + 1], c = lower[2 * i], d = lower[2 * i + 1];
        const int r = (red(a) + red(b) + red(c) + red(d) + 2) / 4,
                  g = (green(a) + green(b) + green(c) + green(d) + 2) / 4,
                  e = (blue(a) + blue(b) + blue(c) + blue(d) + 2) / 4;
        u[i] = top(kColourZero + kUBlue * e - kURed * r - kUGreen * g);
        v[i] = top(kColourZero + kVRed * r - kVGreen * g - kVBlue * e);
    }
}

}  // namespace

FilmPlanes::FilmPlanes(int width, int height)
    : width_(static_cast<std::size_t>(width)),
      height_(static_cast<std::size_t>(height)),
      planes_(width_ * height_ * 3 / 2) {}

const std::vector<std::uint8_t>& FilmPlanes::of(const std::uint32_t* pixels, std::size_t stride) {
    std::uint8_t* u = planes_.data() + width_ * height_;
    std::uint8_t* v = u + width_ * height_ / 4;
    for (std::size_t y = 0; y < height_; y += 2) {
        const std::uint32_t *upper = pixels + y * stride, *lower = upper + stride;
        brightnessOf(upper, width_, planes_.data() + y * width_);
        brightnessOf(lower, width_, planes_.data() + (y + 1) * width_);
        coloursOf(upper, lower, width_ / 2, u + y / 2 * (width_ / 2), v + y / 2 * (width_ / 2));
    }
    return planes_;
}

}  // namespace throng::analysis
