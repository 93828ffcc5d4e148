// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "base/frame.h"

namespace throng::recording {

/// A frame that outlives the receiver's call. The diagram is not kept.
struct KeptFrame {
    explicit KeptFrame(const Frame& frame);
    KeptFrame() = default;
    Frame view() const;
    bool isAlive(std::size_t row) const { return (*this)[Stream::state][row * kComponents] > 0.5f; }

    std::vector<float>& operator[](Stream stream) { return streams[stream]; }
    const std::vector<float>& operator[](Stream stream) const { return streams[stream]; }

    std::uint32_t index = 0;
    PerStream<std::vector<float>> streams;
    std::vector<float> lifts;
};

/// Somebody in a frame, averaged over the frames around it.
struct Average {
    double position[3];
    double heading[2];  ///< cos, sin
    double speed;       ///< m/s
};

/// Frames around one, for averages over time.
///
/// What people do in a crowd is decided step by step, and in a crush bodies push each other to and fro by
/// millimetres in every step. Nobody's eye may see that. A bake knows what comes next, so it can do what a
/// simulation cannot: average over the frames before and after alike, which takes the tremor out and delays
/// nothing. The weights are a Hann window, cos^2: smooth, never negative, and nearly without what a box would
/// let through. Near the beginning and the end of somebody's life the window closes, so that people appear
/// and leave exactly where they did.
class FrameWindow {
  public:
    /// @param half_width s; the window reaches less far than that to both sides; 0: one frame only
    /// @param foresees s: how far beyond the middle frame it is known what comes
    FrameWindow(double half_width, double fps, double foresees = 0.0);

    /// Frames on either side of the one in the middle.
    std::uint32_t reach() const { return reach_; }

    void push(const Frame& frame);
    /// Whether the frame in the middle has all the frames that it waits for.
    bool isReady() const { return frames_.size() > middle_ + reach_ + foreseen_; }
    bool isEmpty() const { return frames_.size() <= middle_; }
    const KeptFrame& middle() const { return frames_[middle_]; }
    /// Makes the next frame the middle one.
    void advance();

    /// A row of the middle frame, in which it is alive.
    Average average(std::size_t row) const;

    /// Which way somebody who is alive in the middle frame will face as far ahead as is foreseen, or in the
    /// last frame before that in which it is alive; an average, too.
    glm::dvec2 headingToCome(std::size_t row) const;

    /// The mean over the same frames of what belongs to the charts that the row is on, behind its places;
    /// zero on charts without a value.
    glm::dvec2 averageOfCharts(std::size_t row, std::span<const glm::dvec2> by_chart) const;

    /// All that average() and what follows depend on, as bytes.
    void save(std::vector<std::byte>& bytes) const;
    /// @param carried the streams that the frames have besides those of every bake
    /// @throws std::runtime_error where the bytes do not fit
    void restore(std::span<const std::byte> bytes, std::size_t rows, const StreamChoice& carried,
                 std::size_t lifts = 0);

  private:
    bool isThere(std::size_t frame, std::size_t row) const;
    std::uint32_t room(std::size_t row, std::size_t centre) const;

    std::uint32_t reach_ = 0, foreseen_ = 0;
    std::vector<std::vector<double>>
        weights_;  ///< by reach: of the middle and those further and further away
    std::deque<KeptFrame> frames_;
    std::size_t middle_ = 0;
};

}  // namespace throng::recording
