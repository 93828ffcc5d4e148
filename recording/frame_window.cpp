// SPDX-License-Identifier: Apache-2.0
#include "recording/frame_window.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>

namespace throng::recording {
namespace {

std::vector<float> kept(std::span<const float> values) {
    return {values.begin(), values.end()};
}

template <class T>
void put(std::vector<std::byte>& bytes, std::span<const T> items) {
    const auto raw = std::as_bytes(items);
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

template <class T>
void take(std::span<const std::byte>& bytes, std::span<T> items) {
    if (bytes.size() < items.size_bytes()) throw std::runtime_error("the checkpoint's frames are cut short");
    if (items.empty()) return;
    std::memcpy(items.data(), bytes.data(), items.size_bytes());
    bytes = bytes.subspan(items.size_bytes());
}

std::uint32_t reachOf(double half_width, double fps) {
    const double frames = half_width * fps;
    return frames <= 1.0 ? 0 : static_cast<std::uint32_t>(std::ceil(frames - 1.0e-6)) - 1;
}

/// A Hann window that is zero just beyond `reach`.
std::vector<double> hann(std::uint32_t reach) {
    std::vector<double> weights(reach + 1);
    double sum = 0.0;
    for (std::uint32_t i = 0; i <= reach; ++i) {
        weights[i] = std::pow(std::cos(0.5 * std::numbers::pi * i / (reach + 1.0)), 2.0);
        sum += (i ? 2.0 : 1.0) * weights[i];
    }
    for (double& weight : weights)
        weight /= sum;
    return weights;
}

}  // namespace

KeptFrame::KeptFrame(const Frame& frame)
    : index(frame.index),
      positions(kept(frame.positions)),
      directions(kept(frame.directions)),
      states(kept(frame.states)),
      densities(kept(frame.densities)) {}

FrameWindow::FrameWindow(double half_width, double fps) : reach_(reachOf(half_width, fps)) {
    for (std::uint32_t reach = 0; reach <= reach_; ++reach)
        weights_.push_back(hann(reach));
}

void FrameWindow::push(const Frame& frame) {
    frames_.emplace_back(frame);
}

void FrameWindow::advance() {
    ++middle_;
    if (middle_ <= reach_) return;
    frames_.pop_front();
    --middle_;
}

/// How far the window reaches for a row: as far as it is alive to both sides.
std::uint32_t FrameWindow::room(std::size_t row) const {
    std::uint32_t reach = 0;
    while (reach < reach_) {
        const std::size_t next = reach + 1;
        if (next > middle_ || middle_ + next >= frames_.size()) break;
        if (!frames_[middle_ - next].isAlive(row) || !frames_[middle_ + next].isAlive(row)) break;
        ++reach;
    }
    return reach;
}

Average FrameWindow::average(std::size_t row) const {
    const std::size_t at = row * 3;
    const std::uint32_t reach = room(row);
    const std::vector<double>& weights = weights_[reach];
    const KeptFrame& centre = frames_[middle_];
    double sums[6];
    for (int k = 0; k < 3; ++k) {
        sums[k] = weights[0] * centre.positions[at + k];
        sums[3 + k] = weights[0] * centre.directions[at + k];
    }
    for (std::uint32_t i = 1; i <= reach; ++i) {
        const KeptFrame& before = frames_[middle_ - i];
        const KeptFrame& after = frames_[middle_ + i];
        for (int k = 0; k < 3; ++k) {
            sums[k] += weights[i] * (double{before.positions[at + k]} + after.positions[at + k]);
            sums[3 + k] += weights[i] * (double{before.directions[at + k]} + after.directions[at + k]);
        }
    }
    Average average{{sums[0], sums[1], sums[2]}, {centre.directions[at], centre.directions[at + 1]}, sums[5]};
    const double length = std::hypot(sums[3], sums[4]);
    constexpr double kTurnsRound = 1.0e-3;  // whoever looks both ways within the window
    if (length > kTurnsRound) {
        average.heading[0] = sums[3] / length;
        average.heading[1] = sums[4] / length;
    }
    return average;
}

void FrameWindow::save(std::vector<std::byte>& bytes) const {
    const std::uint64_t counts[] = {frames_.size(), middle_,
                                    frames_.empty() ? 0 : frames_[0].densities.size()};
    put<std::uint64_t>(bytes, counts);
    for (const KeptFrame& frame : frames_) {
        put<std::uint32_t>(bytes, {&frame.index, 1});
        for (const std::vector<float>* values :
             {&frame.positions, &frame.directions, &frame.states, &frame.densities})
            put<float>(bytes, *values);
    }
}

void FrameWindow::restore(std::span<const std::byte> bytes, std::size_t rows) {
    std::uint64_t counts[3];
    take<std::uint64_t>(bytes, counts);
    if (counts[0] > 2ull * reach_ + 1 || counts[1] > counts[0] || (counts[2] != 0 && counts[2] != rows * 3))
        throw std::runtime_error("the checkpoint's frames do not fit this bake");
    frames_.assign(counts[0], {});
    middle_ = counts[1];
    for (KeptFrame& frame : frames_) {
        take<std::uint32_t>(bytes, {&frame.index, 1});
        frame.densities.resize(counts[2]);
        for (std::vector<float>* values : {&frame.positions, &frame.directions, &frame.states}) {
            values->resize(rows * 3);
            take<float>(bytes, *values);
        }
        take<float>(bytes, frame.densities);
    }
}

}  // namespace throng::recording
