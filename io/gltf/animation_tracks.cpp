// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/animation_tracks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "base/activities.h"

namespace throng::io {
namespace {

/// Values held at once while frame-major streams are turned into tracks.
constexpr std::uint64_t kTileValues = std::uint64_t{8} << 20;

/// The tracks of some rows over all frames, row after row.
class Tile {
  public:
    Tile(const StreamReader& stream, std::span<const TrackRow> rows)
        : frames_(stream.frames()), values_(rows.size() * frames_ * kComponents) {
        const std::uint32_t first = rows.front().row;
        std::vector<float> span(std::size_t{rows.back().row - first + 1} * kComponents);
        for (std::uint32_t frame = 0; frame < frames_; ++frame) {
            stream.readRows(frame, first, span);
            for (std::size_t i = 0; i < rows.size(); ++i)
                std::copy_n(
                    span.begin() + std::ptrdiff_t{rows[i].row - first} * std::ptrdiff_t{kComponents},
                    kComponents,
                    values_.begin() + static_cast<std::ptrdiff_t>((i * frames_ + frame) * kComponents));
        }
    }

    /// Three values of row i of the tile.
    std::span<const float, kComponents> at(std::size_t i, std::uint32_t frame) const {
        return std::span<const float, kComponents>(values_.data() + (i * frames_ + frame) * kComponents,
                                                   kComponents);
    }

  private:
    std::uint32_t frames_;
    std::vector<float> values_;
};

void writeTranslations(OutputFile& file, const Tile& positions, std::size_t i, std::uint32_t frames) {
    std::vector<float> track;
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        const auto p = positions.at(i, frame);
        track.insert(track.end(), {p[0], p[2], -p[1]});
    }
    file.write(std::as_bytes(std::span(track)));
}

/// A turn by the heading about +Y. A rotation has two quaternions; consecutive keys take the nearer one, so
/// that players that interpolate without looking don't spin people round.
void writeRotations(OutputFile& file, const Tile& directions, std::size_t i, std::uint32_t frames) {
    std::vector<std::int16_t> track;
    double last_sine = 0.0;
    double last_cosine = 1.0;
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        const auto d = directions.at(i, frame);
        const double half = 0.5 * std::atan2(static_cast<double>(d[1]), static_cast<double>(d[0]));
        double sine = std::sin(half);
        double cosine = std::cos(half);
        if (sine * last_sine + cosine * last_cosine < 0.0) {
            sine = -sine;
            cosine = -cosine;
        }
        const auto normalised = [](double value) {
            return static_cast<std::int16_t>(std::lround(value * 32767.0));
        };
        track.insert(track.end(), {std::int16_t{0}, normalised(sine), std::int16_t{0}, normalised(cosine)});
        last_sine = sine;
        last_cosine = cosine;
    }
    file.write(std::as_bytes(std::span(track)));
}

/// How high somebody is, of its height: less in a seat.
float uprightAt(std::span<const float, kComponents> state) {
    constexpr float kSits = 0.76f;
    if (!hasSeat(state[0])) return 1.0f;
    const auto activity = static_cast<ActivityCode>(static_cast<int>(std::floor(state[0])));
    if (activity == ActivityCode::cheers || activity == ActivityCode::sings) return 1.0f;
    if (activity != ActivityCode::rises && activity != ActivityCode::settles) return kSits;
    const float phase = state[2] - std::floor(state[2]);
    return kSits + (1.0f - kSits) * (1.0f - std::abs(2.0f * phase - 1.0f));
}

void writeScales(OutputFile& file, const Tile& states, std::size_t i, std::uint32_t frames,
                 const TrackRow& row) {
    std::vector<float> track;
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        const auto state = states.at(i, frame);
        const bool alive = state[0] > 0.5f;
        const float width = alive ? row.width_scale : 0.0f;
        track.insert(track.end(), {width, alive ? row.height_scale * uprightAt(state) : 0.0f, width});
    }
    file.write(std::as_bytes(std::span(track)));
}

}  // namespace

void findScaledRows(const StreamSet& streams, std::vector<TrackRow>& rows) {
    const StreamReader& states = streams[Stream::state];
    if (rows.empty() || states.frames() == 0) return;
    std::vector<float> values(std::size_t{states.rows()} * kComponents);
    for (TrackRow& row : rows)
        row.stays = true;
    for (std::uint32_t frame = 0; frame < states.frames(); ++frame) {
        states.readFrame(frame, values);
        for (TrackRow& row : rows) {
            const float state = values[std::size_t{row.row} * kComponents];
            row.has_scales = row.has_scales || state <= 0.5f || hasSeat(state);
            row.stays = row.stays && hasSeat(state);
        }
    }
    for (const auto& [stream, told] :
         {std::pair(Stream::pos, &TrackRow::place), std::pair(Stream::dir, &TrackRow::direction)}) {
        streams[stream].readFrame(0, values);
        for (TrackRow& row : rows)
            std::copy_n(values.begin() + std::ptrdiff_t{row.row} * std::ptrdiff_t{kComponents}, kComponents,
                        (row.*told).begin());
    }
}
void writeTracks(OutputFile& file, const StreamSet& streams, const std::vector<TrackRow>& rows) {
    const std::uint32_t frames = streams.frames();
    if (rows.empty() || frames == 0) return;
    const auto tile_rows = static_cast<std::size_t>(
        std::max<std::uint64_t>(1, kTileValues / (std::uint64_t{frames} * kComponents)));
    for (std::size_t first = 0; first < rows.size(); first += tile_rows) {
        const std::span tile = std::span(rows).subspan(first, std::min(tile_rows, rows.size() - first));
        const Tile positions(streams[Stream::pos], tile);
        const Tile directions(streams[Stream::dir], tile);
        const Tile states(streams[Stream::state], tile);
        for (std::size_t i = 0; i < tile.size(); ++i) {
            if (!tile[i].stays) {
                writeTranslations(file, positions, i, frames);
                writeRotations(file, directions, i, frames);
            }
            if (tile[i].has_scales) writeScales(file, states, i, frames, tile[i]);
        }
    }
}

}  // namespace throng::io
