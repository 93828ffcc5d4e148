// SPDX-License-Identifier: Apache-2.0
#include "analysis/report/packed_ways.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <new>
#include <stdexcept>

#include "io/storeys.h"

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

std::uint32_t framesBetween(const io::Bake& bake) {
    const double by_time = std::max(1.0, std::round(bake.fps / kMomentsPerSecond));
    const double by_size = std::ceil(2.0 * bake.agents * bake.frames / kMostNumbers);
    return static_cast<std::uint32_t>(std::max(by_time, by_size));
}

}  // namespace

class WayPacker::State {
  public:
    explicit State(const io::Bake& bake) : bake_(bake), packer_(std::size_t{bake.agents} * 2) {
        packed_.every = framesBetween(bake);
        const glm::dvec2 extent = bake.maximum - bake.minimum;
        packed_.quantum = std::max(extent.x, extent.y) / 65535.0;
        packed_.first.assign(bake.agents, 0xffffffffu);
        packed_.last.assign(bake.agents, 0);
    }

    void add(const io::CrowdFrame& frame) {
        for (std::size_t row = 0; row < frame.rows(); ++row)
            if (frame.isThere(row)) {
                packed_.first[row] = std::min(packed_.first[row], frame.index());
                packed_.last[row] = frame.index();
            }
        held_.push_back(frame);
        if (frame.index() % packed_.every == 0 || frame.index() + 1 == bake_.frames) addMoment();
    }

    PackedWays finish() {
        packed_.deflated = packer_.finish();
        if (bake_.hasStoreys()) packed_.deflated_storeys = storey_bytes_.finish();
        if (bake_.streams[Stream::size]) packed_.deflated_sizes = size_bytes_.finish();
        packed_.usual_error = seen_ ? std::sqrt(squares_ / static_cast<double>(seen_)) : 0.0;
        return std::move(packed_);
    }

  private:
    void addMoment() {
        const std::vector<std::uint16_t> to = rounded(held_.back());
        if (from_.empty()) from_ = to;
        // The first of those held is the moment before; it has been compared as the last of the ones then.
        const double span = std::max<double>(1.0, static_cast<double>(held_.size() - 1));
        for (std::size_t i = packed_.moments ? 1 : 0; i < held_.size(); ++i)
            compare(held_[i], to, held_.size() == 1 ? 1.0 : static_cast<double>(i) / span);
        packer_.add(to);
        if (bake_.hasStoreys()) addStoreys(held_.back());
        if (bake_.streams[Stream::size]) addSizes(held_.back());
        ++packed_.moments;
        from_ = to;
        held_.erase(held_.begin(), held_.end() - 1);
    }

    void addStoreys(const io::CrowdFrame& frame) {
        constexpr std::size_t kNowhere = 255;
        std::vector<unsigned char> bytes;
        for (std::size_t row = 0; row < frame.rows(); ++row)
            bytes.push_back(static_cast<unsigned char>(std::min(
                storeys_.storeyAt(frame.place(row), frame.height(row)).value_or(kNowhere), kNowhere)));
        storey_bytes_.add(bytes);
    }

    void addSizes(const io::CrowdFrame& frame) {
        const double least = gpu::LEAST_SIZE, most = gpu::MOST_SIZE;
        std::vector<unsigned char> bytes;
        for (std::size_t row = 0; row < frame.rows(); ++row)
            bytes.push_back(static_cast<unsigned char>(
                std::lround(255.0 * (std::clamp(frame.size(row), least, most) - least) / (most - least))));
        size_bytes_.add(bytes);
    }

    std::vector<std::uint16_t> rounded(const io::CrowdFrame& frame) const {
        std::vector<std::uint16_t> numbers;
        numbers.reserve(2 * frame.rows());
        for (std::size_t row = 0; row < frame.rows(); ++row) {
            const glm::dvec2 offset = frame.place(row) - bake_.minimum;
            for (const double along : {offset.x, offset.y})
                numbers.push_back(static_cast<std::uint16_t>(
                    std::clamp(std::round(along / packed_.quantum), 0.0, 65535.0)));
        }
        return numbers;
    }

    /// With what is shown of a frame: a share of the way from the last moment to the next.
    void compare(const io::CrowdFrame& frame, const std::vector<std::uint16_t>& to, double share) {
        for (std::size_t row = 0; row < frame.rows(); ++row) {
            if (!frame.isThere(row)) continue;
            const auto shown = [&](double minimum, std::size_t i) {
                return minimum + packed_.quantum * (from_[i] + share * (to[i] - from_[i]));
            };
            const glm::dvec2 at(shown(bake_.minimum.x, 2 * row), shown(bake_.minimum.y, 2 * row + 1));
            const double error = glm::distance(frame.place(row), at);
            packed_.largest_error = std::max(packed_.largest_error, error);
            squares_ += error * error;
            ++seen_;
        }
    }

    const io::Bake& bake_;
    io::Storeys storeys_{bake_};
    Packer packer_;
    Deflater storey_bytes_, size_bytes_;
    PackedWays packed_;
    std::vector<io::CrowdFrame> held_;  // since the last moment, it included
    std::vector<std::uint16_t> from_;
    double squares_ = 0.0;
    std::uint64_t seen_ = 0;
};

WayPacker::WayPacker(const io::Bake& bake) : state_(std::make_unique<State>(bake)) {}
WayPacker::~WayPacker() = default;

void WayPacker::add(const io::CrowdFrame& frame) {
    state_->add(frame);
}

PackedWays WayPacker::finish() {
    return state_->finish();
}

}  // namespace throng::analysis
