// SPDX-License-Identifier: Apache-2.0
#include <cairo.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "analysis/preview/film_planes.h"
#include "analysis/preview/marks.h"

namespace throng::test {
namespace {

using analysis::FilmPlanes;
using analysis::Marks;

constexpr Colour kWhite{1.0, 1.0, 1.0};

/// Black, until marks are drawn.
class Picture {
  public:
    explicit Picture(int side)
        : side_(side),
          surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, side, side), cairo_surface_destroy) {}

    cairo_surface_t* surface() const { return surface_.get(); }
    int at(int x, int y) const {
        cairo_surface_flush(surface());
        const auto* row = reinterpret_cast<const std::uint32_t*>(
            cairo_image_surface_get_data(surface()) + y * cairo_image_surface_get_stride(surface()));
        return static_cast<int>(row[x] & 255u);
    }
    /// px: how much of it is white
    double area() const {
        double sum = 0.0;
        for (int y = 0; y < side_; ++y)
            for (int x = 0; x < side_; ++x)
                sum += at(x, y) / 255.0;
        return sum;
    }

  private:
    int side_;
    std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
};

template <class Draw>
double areaOf(const Draw& draw) {
    const Picture picture(64);
    {
        Marks marks(picture.surface());
        marks.use(kWhite, 1.0);
        draw(marks);
    }
    return picture.area();
}

TEST(Marks, CoverAsMuchAsTheyAreLarge) {
    for (const float angle : {0.0f, 0.3f, 0.8f, 2.1f}) {
        const glm::vec2 way(std::cos(angle), std::sin(angle)), middle(31.3f, 30.8f);
        for (const float width : {1.0f, 3.0f})
            EXPECT_NEAR(areaOf([&](Marks& m) { m.line(middle - 10.0f * way, middle + 10.0f * way, width); }),
                        20.0 * width, 0.08 * 20.0 * width + 0.3)
                << angle << " " << width;
        EXPECT_NEAR(areaOf([&](Marks& m) { m.capsule(middle - 6.0f * way, middle + 6.0f * way, 4.0f); }),
                    12.0 * 8.0 + 16.0 * std::numbers::pi, 2.5);
    }
    for (const float radius : {1.6f, 4.0f, 11.0f})
        EXPECT_NEAR(areaOf([&](Marks& m) {
                        m.disc({30.2f, 31.9f}, radius);
                    }),
                    std::numbers::pi * radius * radius, 0.03 * std::numbers::pi * radius * radius + 0.3);
    const auto drawn = [](glm::vec2 a, glm::vec2 b, glm::vec2 c) {
        return areaOf([&](Marks& m) { m.triangle(a, b, c); });
    };
    EXPECT_NEAR(drawn({10, 10}, {40, 12}, {20, 50}), 590.0, 6.0);
    EXPECT_NEAR(drawn({10, 10}, {20, 50}, {40, 12}), 590.0, 6.0) << "whichever way round";
}

TEST(Marks, LinesThatGoOnFromEachOtherAreOneLine) {
    const auto whole = areaOf([](Marks& m) { m.line({5.0f, 20.0f}, {55.0f, 20.0f}, 2.0f); });
    const auto pieces = areaOf([](Marks& m) {
        for (int i = 0; i < 100; ++i)
            m.line({5.0f + 0.5f * static_cast<float>(i), 20.0f}, {5.5f + 0.5f * static_cast<float>(i), 20.0f},
                   2.0f);
    });
    EXPECT_NEAR(whole, 100.0, 0.5);
    EXPECT_GT(pieces, 70.0);
    EXPECT_LT(pieces, whole + 0.5) << "no dark beads where they meet";
    EXPECT_EQ(areaOf([](Marks& m) {
                  m.line({9.0f, 9.0f}, {9.0f, 9.0f}, 3.0f);
              }),
              0.0)
        << "who stands leaves none";
}

/// Of lines, only the pixels between both sides are looked at: none that belongs to one is left out.
TEST(Marks, LinesAslantAreWhole) {
    for (int degrees = 0; degrees < 180; ++degrees)
        for (const float width : {0.7f, 1.0f, 3.0f}) {
            const double angle = degrees * std::numbers::pi / 180.0;
            const glm::vec2 way(std::cos(angle), std::sin(angle)), middle(31.3f, 32.6f);
            const double area =
                areaOf([&](Marks& m) { m.line(middle - 20.0f * way, middle + 20.0f * way, width); });
            EXPECT_NEAR(area, 40.0 * double{width}, 0.08 * 40.0 * double{width}) << degrees << " " << width;
        }
}

TEST(Marks, EndWhereThePictureDoes) {
    EXPECT_NEAR(areaOf([](Marks& m) { m.disc({0.0f, 0.0f}, 20.0f); }), 100.0 * std::numbers::pi, 4.0);
    EXPECT_EQ(areaOf([](Marks& m) {
                  m.disc({-1.0e9f, 30.0f}, 4.0f);
                  m.line({1.0e20f, 5.0f}, {1.0e20f, 9.0f}, 2.0f);
                  m.triangle({200, 200}, {240, 200}, {200, 240});
              }),
              0.0);
}

TEST(Marks, MixByTheirStrength) {
    const Picture picture(16);
    Marks marks(picture.surface());
    marks.use(kWhite, 0.5);
    marks.disc({8.0f, 8.0f}, 6.0f);
    EXPECT_NEAR(picture.at(8, 8), 128, 1);
    marks.disc({8.0f, 8.0f}, 6.0f);
    EXPECT_NEAR(picture.at(8, 8), 191, 2);
}

TEST(FilmPlanes, HaveTheStandardsNumbers) {
    struct Known {
        std::uint32_t pixel;
        int y, u, v;
    };
    // ITU-R BT.601-7, table 4: colour bars of full strength.
    for (const Known& known :
         {Known{0xffffff, 235, 128, 128}, Known{0x000000, 16, 128, 128}, Known{0xff0000, 81, 90, 240},
          Known{0x00ff00, 145, 54, 34}, Known{0x0000ff, 41, 240, 110}, Known{0x808080, 126, 128, 128}}) {
        FilmPlanes planes(6, 4);
        const std::vector<std::uint32_t> pixels(4 * 7, known.pixel);  // rows with something behind them
        const std::vector<std::uint8_t> found = planes.of(pixels.data(), 7);
        ASSERT_EQ(found.size(), 6u * 4u * 3u / 2u);
        EXPECT_NEAR(found[0], known.y, 1) << known.pixel;
        EXPECT_NEAR(found[23], known.y, 1) << known.pixel;
        EXPECT_NEAR(found[24], known.u, 1) << known.pixel;
        EXPECT_NEAR(found[29], known.u, 1) << known.pixel;
        EXPECT_NEAR(found[30], known.v, 1) << known.pixel;
        EXPECT_NEAR(found[35], known.v, 1) << known.pixel;
    }
}

TEST(FilmPlanes, ColoursAreOfFourPixelsEach) {
    FilmPlanes planes(4, 2);
    const std::vector<std::uint32_t> pixels = {0xff0000, 0x0000ff, 0, 0, 0xff0000, 0x0000ff, 0, 0};
    const std::vector<std::uint8_t> found = planes.of(pixels.data(), 4);
    EXPECT_NEAR(found[8], (90 + 240) / 2, 2);
    EXPECT_NEAR(found[10], (240 + 110) / 2, 2);
    EXPECT_EQ(found[9], 128);
    EXPECT_NEAR(found[0], 81, 1);
    EXPECT_NEAR(found[1], 41, 1);
}

}  // namespace
}  // namespace throng::test
