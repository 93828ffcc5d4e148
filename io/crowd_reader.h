// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "io/agent_rows.h"
#include "io/streams/stream_set.h"
#include "shaders/shared/scene_types.h"

namespace throng::io {

/// One frame of a bake. A stream is read when it is first asked for, and once; copies share what has been
/// read.
class CrowdFrame {
  public:
    std::uint32_t index() const { return held_->index; }
    std::size_t rows() const { return held_->streams.rows(); }
    /// rows x 3 values. Throws InputError where the bake has no such stream, or it cannot be read.
    std::span<const float> operator[](Stream stream) const {
        const std::vector<float>& values = held_->values[stream];
        return values.empty() ? read(stream) : values;
    }

    float activity(std::size_t row) const { return (*this)[Stream::state][row * kComponents]; }
    bool isThere(std::size_t row) const { return activity(row) > 0.5f; }
    glm::dvec2 place(std::size_t row) const {
        return inPlane(Stream::pos, row);
    }  ///< m, from the bake's origin
    double height(std::size_t row) const { return (*this)[Stream::pos][row * kComponents + 2]; }  ///< m
    glm::dvec2 facing(std::size_t row) const { return inPlane(Stream::dir, row); }
    /// How much room somebody takes, times what it takes by itself.
    double size(std::size_t row) const {
        return held_->streams.has(Stream::size) ? double{(*this)[Stream::size][row * kComponents]} : 1.0;
    }
    /// The body of somebody, as its chest is turned, and as large as it is just then.
    Capsule body(std::size_t row, const AgentRow& person) const;
    float speed(std::size_t row) const { return (*this)[Stream::dir][row * kComponents + 2]; }  ///< m/s

  private:
    friend class CrowdReader;
    struct Held {
        const StreamSet& streams;
        std::uint32_t index = 0;
        PerStream<std::vector<float>> values;  ///< empty until they are asked for
    };
    std::span<const float> read(Stream stream) const;
    explicit CrowdFrame(std::shared_ptr<Held> held) : held_(std::move(held)) {}
    glm::dvec2 inPlane(Stream stream, std::size_t row) const {
        const auto values = rowOf((*this)[stream], row);
        return {values[0], values[1]};
    }

    std::shared_ptr<Held> held_;
};

/// All that is read of a bake once it is written: its frames, its people, and the places of its manifest.
/// Frames are those of CrowdReader for as long as it lives.
class CrowdReader {
  public:
    explicit CrowdReader(Bake bake);
    CrowdReader(const CrowdReader&) = delete;
    CrowdReader& operator=(const CrowdReader&) = delete;

    const Bake& bake() const { return bake_; }
    std::uint32_t frames() const { return bake_.frames; }
    std::uint32_t rows() const { return bake_.agents; }
    /// What nobody is larger than, times what it is by itself.
    double mostSize() const { return streams_.has(Stream::size) ? double{gpu::MOST_SIZE} : 1.0; }
    /// For single rows out of order.
    const StreamSet& streams() const { return streams_; }

    /// From here on, the last so many different frames that were asked for are not read again; at first, one.
    void keep(std::size_t frames) { most_kept_ = std::max<std::size_t>(frames, 1); }
    /// Throws std::out_of_range when the bake has no such frame.
    CrowdFrame frame(std::uint32_t index);
    /// agents.csv, as loadAgentRows().
    const std::vector<AgentRow>& people();

  private:
    Bake bake_;
    StreamSet streams_;
    std::size_t most_kept_ = 1;
    std::vector<std::shared_ptr<CrowdFrame::Held>> kept_;  ///< the one asked for last at the end
    std::optional<std::vector<AgentRow>> people_;
};

}  // namespace throng::io
