// SPDX-License-Identifier: Apache-2.0
#include "io/diagram/diagram_exr.h"

#include <ImathMatrix.h>
#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfFramesPerSecond.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <vector>

#include "base/files/output_file.h"
#include "io/diagram/chart_pictures.h"

namespace throng::io {
namespace {

/// Blocks of lines that ZIP compresses together.
constexpr std::uint32_t kLines = 16;

/// The library writes the table of line offsets in a destructor, where it has to swallow errors. So the first
/// error is remembered here, and everything after it is dropped; check() tells it.
class CheckedStream : public Imf::OStream {
  public:
    explicit CheckedStream(OutputFile& file) : OStream(file.path().c_str()), file_(file) {}

    void write(const char bytes[], int count) override {
        if (!error_) try {
                file_.writeAt(position_, std::as_bytes(std::span(bytes, static_cast<std::size_t>(count))));
            } catch (...) {
                error_ = std::current_exception();
            }
        position_ += static_cast<std::uint64_t>(count);
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }

    void check() const {
        if (error_) std::rethrow_exception(error_);
    }

  private:
    OutputFile& file_;
    std::uint64_t position_ = 0;
    std::exception_ptr error_;
};

constexpr const char* kPicture[] = {"R", "G", "B", "A"};

/// A colour of its own for each person: neighbours in the table are far apart on the wheel. Linear light.
std::array<float, 3> colourOf(std::uint32_t row) {
    const float hue = 6.0f * std::fmod(static_cast<float>(row % 4096u) * 0.61803399f, 1.0f);
    const float value = (row & 1u) != 0u ? 0.75f : 0.45f;
    std::array<float, 3> colour{};
    for (std::size_t part = 0; part < 3; ++part) {
        const float away = std::fmod(hue + (part == 0 ? 5.0f : part == 1 ? 3.0f : 1.0f), 6.0f);
        colour[part] = value * (1.0f - 0.7f * std::clamp(std::min(away, 4.0f - away), 0.0f, 1.0f));
    }
    return colour;
}

/// Cells are bright around their owner and darker towards their edge (1/m).
constexpr float kShade = 1.5f;

/// A diagram and what is known of its owners.
struct DiagramContent {
    const DiagramImage& image;
    std::span<const float> densities;
    const ChartPixels* chart = nullptr;  ///< of whose picture it is; null: of all
    bool hasSecond() const { return !image.second.empty(); }
    bool hasDensity() const { return !densities.empty(); }
};

/// Where a diagram is in the world, and in its file.
struct DiagramPlace {
    glm::dvec2 minimum{0.0};  ///< m, world: the lower left corner
    glm::ivec2 window{0};     ///< the upper left pixel
};

void addChannels(Imf::Header& header, bool second, bool density) {
    header.compression() = Imf::ZIP_COMPRESSION;
    header.channels().insert("id", Imf::Channel(Imf::UINT));
    header.channels().insert("kind", Imf::Channel(Imf::UINT));
    header.channels().insert("distance", Imf::Channel(Imf::FLOAT));
    for (const char* name : kPicture)
        header.channels().insert(name, Imf::Channel(Imf::HALF));
    if (second)
        for (const char* name : {"second", "secondKind"})
            header.channels().insert(name, Imf::Channel(Imf::UINT));
    if (density) header.channels().insert("density", Imf::Channel(Imf::FLOAT));
}

void addPlace(Imf::Header& header, const DiagramPlace& place, double scale, int height) {
    Imath::M33d to_pixel;  // row vectors: the translation is in the last row
    to_pixel[0][0] = scale;
    to_pixel[1][1] = -scale;
    to_pixel[2][0] = place.window.x - place.minimum.x * scale;
    to_pixel[2][1] = place.window.y + place.minimum.y * scale + height;
    header.insert("throng:worldToPixel", Imf::M33dAttribute(to_pixel));
    header.insert("throng:minimum", Imf::V2dAttribute(Imath::V2d(place.minimum.x, place.minimum.y)));
    header.insert("throng:pixelsPerMetre", Imf::DoubleAttribute(scale));
}

void addTime(Imf::Header& header, std::uint32_t frame_index, double fps) {
    header.insert("throng:frame", Imf::IntAttribute(static_cast<int>(frame_index + 1)));
    Imf::addFramesPerSecond(header, Imf::guessExactFps(fps));
}

Imf::Header describe(const DiagramContent& content, glm::dvec2 scene_origin, std::uint32_t frame_index,
                     double fps) {
    const DiagramImage& image = content.image;
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    addChannels(header, content.hasSecond(), content.hasDensity());
    addPlace(header, {scene_origin + glm::dvec2(image.minimum), {}}, image.pixels_per_metre,
             static_cast<int>(image.height));
    addTime(header, frame_index, fps);
    return header;
}

/// World coordinates of somebody who looks down on all of the site, in single precision.
Imath::M44f toDevice(const ChartPicture& picture, glm::ivec2 site, double scale) {
    Imath::M44f matrix;
    const glm::dvec2 per_metre = scale / glm::dvec2(site);
    matrix[0][0] = static_cast<float>(per_metre.x);
    matrix[1][1] = static_cast<float>(-per_metre.y);
    const double left = picture.window.x / scale - picture.minimum.x;
    const double top = (picture.window.y + picture.size.y) / scale + picture.minimum.y;
    matrix[3][0] = static_cast<float>(left * per_metre.x);
    matrix[3][1] = static_cast<float>(top * per_metre.y);
    return matrix;
}

Imf::Header describePart(const ChartPicture& picture, const ChartPictures& all, const DiagramImage& plane,
                         const Frame& frame, const recording::BakeDescription& bake) {
    const auto box = [](glm::ivec2 first, glm::ivec2 size) {
        return Imath::Box2i({first.x, first.y}, {first.x + size.x - 1, first.y + size.y - 1});
    };
    const recording::BakeCharts::Picture& about = bake.charts->pictures[picture.chart];
    const double scale = plane.pixels_per_metre;
    Imf::Header header(box({0, 0}, all.site), box(picture.window, picture.size));
    header.setName(about.name);
    header.setType(Imf::SCANLINEIMAGE);
    addChannels(header, !plane.second.empty(), !frame[Stream::density].empty());
    header.channels().insert("ground", Imf::Channel(Imf::UINT));
    header.channels().insert("height", Imf::Channel(Imf::FLOAT));
    addPlace(header, {picture.minimum, picture.window}, scale, picture.size.y);
    addTime(header, frame.index, bake.fps);
    Imf::addWorldToNDC(header, toDevice(picture, all.site, scale));
    header.insert("throng:metresPerPixel", Imf::DoubleAttribute(1.0 / scale));
    header.insert("throng:chart", Imf::IntAttribute(static_cast<int>(picture.chart)));
    header.insert("throng:kind", Imf::StringAttribute(about.kind));
    header.insert("throng:level", Imf::StringAttribute(about.level));
    header.insert("throng:lowest", Imf::DoubleAttribute(about.lowest));
    header.insert("throng:highest", Imf::DoubleAttribute(about.highest));
    return header;
}

/// The pixels of up to kLines lines, top row first.
struct Lines {
    Lines(std::size_t width, const DiagramContent& content)
        : id(width * kLines),
          kind(width * kLines),
          second(content.hasSecond() ? width * kLines : 0),
          second_kind(second.size()),
          distance(width * kLines),
          density(content.hasDensity() ? width * kLines : 0),
          height(content.chart ? width * kLines : 0),
          ground(height.size()) {
        for (std::vector<half>& part : picture)
            part.resize(width * kLines);
    }

    /// Each kind counts its own.
    static void put(std::uint32_t site, const DiagramImage& image, std::uint32_t& number,
                    std::uint32_t& what) {
        number = site;
        what = site == kNone ? 0 : 1;
        if (what == 0 || site < image.agent_count) return;
        number = site - image.agent_count;
        what = 2;
        if (number < image.wall_count) return;
        number -= image.wall_count;
        what = 3;
    }

    void paint(std::size_t at, std::uint32_t row, float away) {
        const std::array<float, 3> colour = row == kNone ? std::array<float, 3>{} : colourOf(row);
        for (std::size_t part = 0; part < 3; ++part)
            picture[part][at] = colour[part] / (1.0f + kShade * std::max(away, 0.0f));
        picture[3][at] = row == kNone ? 0.0f : 1.0f;
    }

    void fill(const DiagramContent& content, std::uint32_t top, std::uint32_t count) {
        const DiagramImage& image = content.image;
        for (std::uint32_t line = 0; line < count; ++line) {
            const std::size_t from = std::size_t{image.height - 1 - (top + line)} * image.width;
            const std::size_t to = std::size_t{line} * image.width;
            for (std::uint32_t x = 0; x < image.width; ++x) {
                const std::uint32_t site = image.site[from + x];
                put(site, image, id[to + x], kind[to + x]);
                distance[to + x] = site == kNone ? -1.0f : image.distance[from + x];
                paint(to + x, site < image.agent_count ? site : kNone, distance[to + x]);
                if (content.hasSecond())
                    put(image.second[from + x], image, second[to + x], second_kind[to + x]);
                if (content.hasDensity())
                    density[to + x] =
                        site < image.agent_count ? content.densities[std::size_t{3} * site] : 0.0f;
            }
            if (!content.chart) continue;
            std::copy_n(content.chart->height.begin() + static_cast<long>(from), image.width,
                        height.begin() + static_cast<long>(to));
            std::copy_n(content.chart->ground.begin() + static_cast<long>(from), image.width,
                        ground.begin() + static_cast<long>(to));
        }
    }

    std::vector<std::uint32_t> id, kind, second, second_kind;
    std::vector<float> distance, density, height;
    std::vector<std::uint32_t> ground;
    std::array<std::vector<half>, 4> picture;
};

/// @param output a file, or a part of one
/// @param window the upper left pixel
template <typename Output>
void writePixels(Output& output, const DiagramContent& content, glm::ivec2 window = {}) {
    const DiagramImage& image = content.image;
    Lines lines(image.width, content);
    for (std::uint32_t top = 0; top < image.height; top += kLines) {
        const std::uint32_t count = std::min(kLines, image.height - top);
        lines.fill(content, top, count);
        const Imath::V2i first(window.x, window.y + static_cast<int>(top));
        Imf::FrameBuffer buffer;
        const auto insert = [&](const char* name, Imf::PixelType type, auto& pixels) {
            buffer.insert(name, Imf::Slice::Make(type, pixels.data(), first, std::int64_t{image.width},
                                                 std::int64_t{kLines}));
        };
        insert("id", Imf::UINT, lines.id);
        insert("kind", Imf::UINT, lines.kind);
        insert("distance", Imf::FLOAT, lines.distance);
        for (std::size_t part = 0; part < lines.picture.size(); ++part)
            insert(kPicture[part], Imf::HALF, lines.picture[part]);
        if (content.hasSecond()) {
            insert("second", Imf::UINT, lines.second);
            insert("secondKind", Imf::UINT, lines.second_kind);
        }
        if (content.hasDensity()) insert("density", Imf::FLOAT, lines.density);
        if (content.chart) {
            insert("ground", Imf::UINT, lines.ground);
            insert("height", Imf::FLOAT, lines.height);
        }
        output.setFrameBuffer(buffer);
        output.writePixels(static_cast<int>(count));
    }
}

/// What any picture of a diagram needs.
void requireWhole(const DiagramImage& image, std::span<const float> densities) {
    const std::size_t pixels = std::size_t{image.width} * image.height;
    if (pixels == 0 || image.site.size() != pixels || image.distance.size() != pixels)
        throw std::invalid_argument("a diagram has one owner and one distance for each pixel");
    if (!image.second.empty() && image.second.size() != pixels)
        throw std::invalid_argument("a diagram with second owners has one for each pixel");
    if (!densities.empty() && densities.size() < std::size_t{3} * image.agent_count)
        throw std::invalid_argument("densities have three values for each person");
}

/// @param write what goes into the file
template <typename Write>
void writeExr(const std::filesystem::path& path, const Write& write) {
    OutputFile file(path);
    CheckedStream stream(file);
    try {
        write(stream);
    } catch (const std::exception& error) {
        stream.check();
        throw OutputError(path, std::string("cannot be encoded: ") + error.what());
    }
    stream.check();
    file.finish();
}

}  // namespace

void writeDiagramExr(const std::filesystem::path& path, const DiagramImage& image,
                     std::span<const float> densities, glm::dvec2 scene_origin, std::uint32_t frame_index,
                     double fps) {
    requireWhole(image, densities);
    const DiagramContent content{image, densities};
    writeExr(path, [&](CheckedStream& stream) {
        Imf::OutputFile output(stream, describe(content, scene_origin, frame_index, fps), 0);
        writePixels(output, content);
    });
}

void writeChartsExr(const std::filesystem::path& path, const DiagramImage& plane, const Frame& frame,
                    const recording::BakeDescription& bake) {
    const std::span<const float> densities = frame[Stream::density];
    requireWhole(plane, densities);
    const ChartPictures all = layPictures(plane, bake);
    std::vector<Imf::Header> headers;
    for (const ChartPicture& picture : all.pictures)
        headers.push_back(describePart(picture, all, plane, frame, bake));
    writeExr(path, [&](CheckedStream& stream) {
        Imf::MultiPartOutputFile output(stream, headers.data(), static_cast<int>(headers.size()), false, 0);
        for (std::size_t i = 0; i < all.pictures.size(); ++i) {
            const ChartPixels pixels = pixelsOf(all.pictures[i], plane, frame[Stream::pos], bake);
            Imf::OutputPart part(output, static_cast<int>(i));
            writePixels(part, {pixels.image, densities, &pixels}, all.pictures[i].window);
        }
    });
}

}  // namespace throng::io
