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

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <vector>

#include "io/files/output_file.h"

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

Imf::Header describe(const DiagramImage& image, glm::dvec2 scene_origin, std::uint32_t frame_index,
                     double fps) {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    header.channels().insert("id", Imf::Channel(Imf::UINT));
    header.channels().insert("kind", Imf::Channel(Imf::UINT));
    header.channels().insert("distance", Imf::Channel(Imf::FLOAT));

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
    explicit Lines(std::size_t width) : id(width * kLines), kind(width * kLines), distance(width * kLines) {}

    void fill(const DiagramImage& image, std::uint32_t top, std::uint32_t count) {
        for (std::uint32_t line = 0; line < count; ++line) {
            const std::size_t from = std::size_t{image.height - 1 - (top + line)} * image.width;
            const std::size_t to = std::size_t{line} * image.width;
            for (std::uint32_t x = 0; x < image.width; ++x) {
                const std::uint32_t site = image.site[from + x];
                const bool is_wall = site != kNone && site >= image.agent_count;
                id[to + x] = is_wall ? site - image.agent_count : site;
                kind[to + x] = site == kNone ? 0 : is_wall ? 2 : 1;
                distance[to + x] = site == kNone ? -1.0f : image.distance[from + x];
            }
        }
    }

    std::vector<std::uint32_t> id;
    std::vector<std::uint32_t> kind;
    std::vector<float> distance;
};

template <typename T>
Imf::Slice sliceOf(Imf::PixelType type, std::vector<T>& pixels, std::uint32_t top, std::uint32_t width) {
    return Imf::Slice::Make(type, pixels.data(), Imath::V2i(0, static_cast<int>(top)),
                            static_cast<int64_t>(width), static_cast<int64_t>(kLines));
}

void writePixels(Imf::OutputFile& output, const DiagramImage& image) {
    Lines lines(image.width);
    for (std::uint32_t top = 0; top < image.height; top += kLines) {
        const std::uint32_t count = std::min(kLines, image.height - top);
        lines.fill(image, top, count);
        Imf::FrameBuffer buffer;
        buffer.insert("id", sliceOf(Imf::UINT, lines.id, top, image.width));
        buffer.insert("kind", sliceOf(Imf::UINT, lines.kind, top, image.width));
        buffer.insert("distance", sliceOf(Imf::FLOAT, lines.distance, top, image.width));
        output.setFrameBuffer(buffer);
        output.writePixels(static_cast<int>(count));
    }
}

}  // namespace

void writeDiagramExr(const std::filesystem::path& path, const DiagramImage& image, glm::dvec2 scene_origin,
                     std::uint32_t frame_index, double fps) {
    const std::size_t pixels = std::size_t{image.width} * image.height;
    if (pixels == 0 || image.site.size() != pixels || image.distance.size() != pixels)
        throw std::invalid_argument("a diagram has one owner and one distance for each pixel");
    OutputFile file(path);
    CheckedStream stream(file);
    try {
        Imf::OutputFile output(stream, describe(image, scene_origin, frame_index, fps), 0);
        writePixels(output, image);
    } catch (const std::exception& error) {
        stream.check();
        throw OutputError(path, std::string("cannot be encoded: ") + error.what());
    }
    stream.check();
    file.finish();
}

}  // namespace throng::io
