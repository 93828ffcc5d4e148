// SPDX-License-Identifier: Apache-2.0
#include "analysis/report/packed_ways.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

#include "io/streams/stream_reader.h"

namespace throng::analysis {
namespace {

constexpr double kMomentsPerSecond = 8.0;
constexpr double kMostNumbers = 64.0e6;  // that a browser is asked to keep

class Deflater {
  public:
    Deflater() {
        if (deflateInit(&stream_, 6) != Z_OK) throw std::bad_alloc();
    }
    ~Deflater() { deflateEnd(&stream_); }
    Deflater(const Deflater&) = delete;
    Deflater& operator=(const Deflater&) = delete;

    void add(std::vector<unsigned char>& bytes) { run(bytes, Z_NO_FLUSH); }
    std::vector<unsigned char> finish() {
        std::vector<unsigned char> nothing;
        run(nothing, Z_FINISH);
        return std::move(output_);
    }

  private:
    void run(std::vector<unsigned char>& bytes, int flush) {
        stream_.next_in = bytes.data();
        stream_.avail_in = static_cast<uInt>(bytes.size());
        unsigned char piece[65536];
        do {
            stream_.next_out = piece;
            stream_.avail_out = sizeof piece;
            deflate(&stream_, flush);
            output_.insert(output_.end(), piece, piece + (sizeof piece - stream_.avail_out));
        } while (stream_.avail_out == 0);
    }

    z_stream stream_{};
    std::vector<unsigned char> output_;
};

/// Writes moment after moment.
class Packer {
  public:
    explicit Packer(std::size_t numbers) : last_(numbers), before_last_(numbers), bytes_(2 * numbers) {}

    void add(const std::vector<std::uint16_t>& moment) {
        for (std::size_t i = 0; i < moment.size(); ++i) {
            const auto expected = static_cast<std::uint16_t>(2 * last_[i] - before_last_[i]);
            const auto left = static_cast<std::int16_t>(moment[i] - expected);
            const auto folded = static_cast<std::uint16_t>((left << 1) ^ (left >> 15));
            bytes_[i] = static_cast<unsigned char>(folded & 255u);
            bytes_[moment.size() + i] = static_cast<unsigned char>(folded >> 8);
        }
        before_last_ = std::move(last_);
        last_ = moment;
        deflater_.add(bytes_);
    }
    std::vector<unsigned char> finish() { return deflater_.finish(); }

  private:
    std::vector<std::uint16_t> last_, before_last_;
    std::vector<unsigned char> bytes_;
    Deflater deflater_;
};

/// Reads positions, and who is there.
class Ways {
  public:
    explicit Ways(const io::Bake& bake)
        : positions_(bake.streamPath(Stream::pos)),
          states_(bake.streamPath(Stream::state)),
          values_(std::size_t{bake.agents} * 3) {
        for (const io::StreamReader* stream : {&positions_, &states_})
            if (stream->rows() != bake.agents || stream->frames() != bake.frames)
                throw InputError(bake.folder / "streams",
                                 "the streams have other numbers of people or frames than bake.json");
    }
    void read(std::uint32_t frame, std::vector<glm::vec2>& places, std::vector<bool>& present) {
        places.resize(values_.size() / 3);
        present.resize(places.size());
        positions_.readFrame(frame, values_);
        for (std::size_t row = 0; row < places.size(); ++row)
            places[row] = {values_[3 * row], values_[3 * row + 1]};
        states_.readFrame(frame, values_);
        for (std::size_t row = 0; row < places.size(); ++row)
            present[row] = values_[3 * row] > 0.5f;
    }

  private:
    io::StreamReader positions_, states_;
    std::vector<float> values_;
};

std::uint32_t framesBetween(const io::Bake& bake) {
    const double by_time = std::max(1.0, std::round(bake.fps / kMomentsPerSecond));
    const double by_size = std::ceil(2.0 * bake.agents * bake.frames / kMostNumbers);
    return static_cast<std::uint32_t>(std::max(by_time, by_size));
}

}  // namespace

PackedWays packWays(const io::Bake& bake) {
    PackedWays packed;
    packed.every = framesBetween(bake);
    const glm::dvec2 extent = bake.maximum - bake.minimum;
    packed.quantum = std::max(extent.x, extent.y) / 65535.0;
    packed.first.assign(bake.agents, 0xffffffffu);
    packed.last.assign(bake.agents, 0);
    Ways ways(bake);
    Packer packer(std::size_t{bake.agents} * 2);
    const auto rounded = [&](const std::vector<glm::vec2>& places) {
        std::vector<std::uint16_t> numbers;
        numbers.reserve(2 * places.size());
        for (const glm::vec2 place : places)
            for (const double offset : {place.x - bake.minimum.x, place.y - bake.minimum.y})
                numbers.push_back(static_cast<std::uint16_t>(
                    std::clamp(std::round(offset / packed.quantum), 0.0, 65535.0)));
        return numbers;
    };
    struct Held {
        std::vector<glm::vec2> places;
        std::vector<bool> present;
    };
    std::vector<Held> held;  // frames since the last moment, it included
    std::vector<std::uint16_t> from;
    double squares = 0.0;
    std::uint64_t seen = 0;
    const auto compare = [&](const Held& frame, const std::vector<std::uint16_t>& a,
                             const std::vector<std::uint16_t>& b, double share) {
        for (std::size_t row = 0; row < frame.places.size(); ++row) {
            if (!frame.present[row]) continue;
            const double x =
                bake.minimum.x + packed.quantum * (a[2 * row] + share * (b[2 * row] - a[2 * row]));
            const double y = bake.minimum.y +
                             packed.quantum * (a[2 * row + 1] + share * (b[2 * row + 1] - a[2 * row + 1]));
            const double error = std::hypot(frame.places[row].x - x, frame.places[row].y - y);
            packed.largest_error = std::max(packed.largest_error, error);
            squares += error * error;
            ++seen;
        }
    };
    for (std::uint32_t frame = 0; frame < bake.frames; ++frame) {
        Held now;
        ways.read(frame, now.places, now.present);
        for (std::size_t row = 0; row < now.places.size(); ++row)
            if (now.present[row]) {
                packed.first[row] = std::min(packed.first[row], frame);
                packed.last[row] = frame;
            }
        held.push_back(std::move(now));
        if (frame % packed.every != 0 && frame + 1 < bake.frames) continue;
        const std::vector<std::uint16_t> to = rounded(held.back().places);
        if (from.empty()) from = to;
        // The first of those held is the moment before; it has been compared as the last of the ones then.
        const double span = std::max<double>(1.0, static_cast<double>(held.size() - 1));
        for (std::size_t i = packed.moments ? 1 : 0; i < held.size(); ++i)
            compare(held[i], from, to, held.size() == 1 ? 1.0 : static_cast<double>(i) / span);
        packer.add(to);
        ++packed.moments;
        from = to;
        held.erase(held.begin(), held.end() - 1);
    }
    packed.deflated = packer.finish();
    packed.usual_error = seen ? std::sqrt(squares / static_cast<double>(seen)) : 0.0;
    return packed;
}

}  // namespace throng::analysis
