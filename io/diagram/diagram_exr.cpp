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
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfVecAttribute.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <vector>

#include "base/files/output_file.h"

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
    bool hasSecond() const { return !image.second.empty(); }
    bool hasDensity() const { return !densities.empty(); }
};

Imf::Header describe(const DiagramContent& content, glm::dvec2 scene_origin, std::uint32_t frame_index,
                     double fps) {
    const DiagramImage& image = content.image;
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    header.channels().insert("id", Imf::Channel(Imf::UINT));
    header.channels().insert("kind", Imf::Channel(Imf::UINT));
    header.channels().insert("distance", Imf::Channel(Imf::FLOAT));
    for (const char* name : kPicture)
        header.channels().insert(name, Imf::Channel(Imf::HALF));
    if (content.hasSecond())
        for (const char* name : {"second", "secondKind"})
            header.channels().insert(name, Imf::Channel(Imf::UINT));
    if (content.hasDensity()) header.channels().insert("density", Imf::Channel(Imf::FLOAT));

    const double scale = image.pixels_per_metre;
    const glm::dvec2 minimum = scene_origin + glm::dvec2(image.minimum);
    Imath::M33d to_pixel;  // row vectors: the translation is in the last row
    to_pixel[0][0] = scale;
    to_pixel[1][1] = -scale;
    to_pixel[2][0] = -minimum.x * scale;
    to_pixel[2][1] = minimum.y * scale + image.height;
    header.insert("throng:worldToPixel", Imf::M33dAttribute(to_pixel));
    header.insert("throng:minimum", Imf::V2dAttribute(Imath::V2d(minimum.x, minimum.y)));
    header.insert("throng:pixelsPerMetre", Imf::DoubleAttribute(scale));
    header.insert("throng:frame", Imf::IntAttribute(static_cast<int>(frame_index + 1)));
    Imf::addFramesPerSecond(header, Imf::guessExactFps(fps));
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
          density(content.hasDensity() ? width * kLines : 0) {
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
        }
    }

    std::vector<std::uint32_t> id, kind, second, second_kind;
    std::vector<float> distance, density;
    std::array<std::vector<half>, 4> picture;
};

template <typename T>
Imf::Slice sliceOf(Imf::PixelType type, std::vector<T>& pixels, std::uint32_t top, std::uint32_t width) {
    return Imf::Slice::Make(type, pixels.data(), Imath::V2i(0, static_cast<int>(top)),
                            static_cast<int64_t>(width), static_cast<int64_t>(kLines));
}

void writePixels(Imf::OutputFile& output, const DiagramContent& content) {
    const DiagramImage& image = content.image;
    Lines lines(image.width, content);
    for (std::uint32_t top = 0; top < image.height; top += kLines) {
        const std::uint32_t count = std::min(kLines, image.height - top);
        lines.fill(content, top, count);
        Imf::FrameBuffer buffer;
        buffer.insert("id", sliceOf(Imf::UINT, lines.id, top, image.width));
        buffer.insert("kind", sliceOf(Imf::UINT, lines.kind, top, image.width));
        buffer.insert("distance", sliceOf(Imf::FLOAT, lines.distance, top, image.width));
        for (std::size_t part = 0; part < lines.picture.size(); ++part)
            buffer.insert(kPicture[part], sliceOf(Imf::HALF, lines.picture[part], top, image.width));
        if (content.hasSecond()) {
            buffer.insert("second", sliceOf(Imf::UINT, lines.second, top, image.width));
            buffer.insert("secondKind", sliceOf(Imf::UINT, lines.second_kind, top, image.width));
        }
        if (content.hasDensity())
            buffer.insert("density", sliceOf(Imf::FLOAT, lines.density, top, image.width));
        output.setFrameBuffer(buffer);
        output.writePixels(static_cast<int>(count));
    }
}

}  // namespace

void writeDiagramExr(const std::filesystem::path& path, const DiagramImage& image,
                     std::span<const float> densities, glm::dvec2 scene_origin, std::uint32_t frame_index,
                     double fps) {
    const std::size_t pixels = std::size_t{image.width} * image.height;
    if (pixels == 0 || image.site.size() != pixels || image.distance.size() != pixels)
        throw std::invalid_argument("a diagram has one owner and one distance for each pixel");
    if (!image.second.empty() && image.second.size() != pixels)
        throw std::invalid_argument("a diagram with second owners has one for each pixel");
    if (!densities.empty() && densities.size() < std::size_t{3} * image.agent_count)
        throw std::invalid_argument("densities have three values for each person");
    const DiagramContent content{image, densities};
    OutputFile file(path);
    CheckedStream stream(file);
    try {
        Imf::OutputFile output(stream, describe(content, scene_origin, frame_index, fps), 0);
        writePixels(output, content);
    } catch (const std::exception& error) {
        stream.check();
        throw OutputError(path, std::string("cannot be encoded: ") + error.what());
    }
    stream.check();
    file.finish();
}

}  // namespace throng::io
