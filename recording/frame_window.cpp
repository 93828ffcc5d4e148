// SPDX-License-Identifier: Apache-2.0
#include "recording/frame_window.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>

#include "base/lift_track.h"

namespace throng::recording {
namespace {

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

std::uint32_t framesIn(double half_width, double fps) {
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

KeptFrame::KeptFrame(const Frame& frame) : index(frame.index) {
    for (const StreamInfo& info : kStreams) {
        // Others are made of the motion once that is steady.
        if (info.source == StreamSource::terrain || info.source == StreamSource::pose) continue;
        streams[info.id].assign(frame[info.id].begin(), frame[info.id].end());
    }
    lifts.assign(frame.lifts.begin(), frame.lifts.end());
}

Frame KeptFrame::view() const {
    Frame frame{index};
    for (const StreamInfo& info : kStreams)
        frame[info.id] = streams[info.id];
    return frame;
}

FrameWindow::FrameWindow(double half_width, double fps, double foresees)
    : reach_(framesIn(half_width, fps)), foreseen_(static_cast<std::uint32_t>(std::lround(foresees * fps))) {
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

bool FrameWindow::isThere(std::size_t frame, std::size_t row) const {
    return frame < frames_.size() && frames_[frame].isAlive(row);
}

/// How far the window reaches for a row: as far as it is alive to both sides of a frame.
std::uint32_t FrameWindow::room(std::size_t row, std::size_t centre) const {
    std::uint32_t reach = 0;
    while (reach < reach_ && reach < centre && isThere(centre - reach - 1, row) &&
           isThere(centre + reach + 1, row))
        ++reach;
    return reach;
}

Average FrameWindow::average(std::size_t row) const {
    const std::size_t at = row * kComponents;
    const std::uint32_t reach = room(row, middle_);
    const std::vector<double>& weights = weights_[reach];
    const KeptFrame& centre = frames_[middle_];
    const auto sumOf = [&](Stream stream, std::size_t component) {
        double sum = weights[0] * centre[stream][at + component];
        for (std::uint32_t i = 1; i <= reach; ++i)
            sum += weights[i] * (double{frames_[middle_ - i][stream][at + component]} +
                                 frames_[middle_ + i][stream][at + component]);
        return sum;
    };
    Average average{{sumOf(Stream::pos, 0), sumOf(Stream::pos, 1), sumOf(Stream::pos, 2)},
                    {centre[Stream::dir][at], centre[Stream::dir][at + 1]},
                    sumOf(Stream::dir, 2)};
    const double x = sumOf(Stream::dir, 0), y = sumOf(Stream::dir, 1);
    const double length = std::hypot(x, y);
    constexpr double kTurnsRound = 1.0e-3;  // whoever looks both ways within the window
    if (length > kTurnsRound) {
        average.heading[0] = x / length;
        average.heading[1] = y / length;
    }
    return average;
}

glm::dvec2 FrameWindow::headingToCome(std::size_t row) const {
    std::size_t centre = middle_;
    while (centre < middle_ + foreseen_ && isThere(centre + 1, row))
        ++centre;
    const std::uint32_t reach = room(row, centre);
    glm::dvec2 sum(0.0);
    for (std::size_t frame = centre - reach; frame <= centre + reach; ++frame) {
        const std::size_t off = frame < centre ? centre - frame : frame - centre;
        const auto facing = rowOf(std::span(frames_[frame][Stream::dir]), row);
        sum += weights_[reach][off] * glm::dvec2(facing[0], facing[1]);
    }
    return sum;
}

glm::dvec2 FrameWindow::averageOfCharts(std::size_t row, std::span<const glm::dvec2> by_chart) const {
    const std::uint32_t reach = room(row, middle_);
    const std::vector<double>& weights = weights_[reach];
    const auto valueIn = [&](const KeptFrame& frame) {
        const auto chart = static_cast<std::size_t>(frame[Stream::pos][row * kComponents + 2]);
        return chart < by_chart.size() ? by_chart[chart] : glm::dvec2(0.0);
    };
    glm::dvec2 sum = weights[0] * valueIn(frames_[middle_]);
    for (std::uint32_t i = 1; i <= reach; ++i)
        sum += weights[i] * (valueIn(frames_[middle_ - i]) + valueIn(frames_[middle_ + i]));
    return sum;
}

void FrameWindow::save(std::vector<std::byte>& bytes) const {
    std::uint64_t counts[] = {frames_.size(), middle_, 0};
    for (const StreamInfo& info : kStreams)
        if (!frames_.empty() && info.source != StreamSource::motion) counts[2] += frames_[0][info.id].size();
    put<std::uint64_t>(bytes, counts);
    for (const KeptFrame& frame : frames_) {
        put<std::uint32_t>(bytes, {&frame.index, 1});
        for (const StreamInfo& info : kStreams)
            put<float>(bytes, frame[info.id]);
        put<float>(bytes, frame.lifts);
    }
}

void FrameWindow::restore(std::span<const std::byte> bytes, std::size_t rows, const StreamChoice& carried,
                          std::size_t lifts) {
    std::uint64_t counts[3];
    take<std::uint64_t>(bytes, counts);
    const std::size_t values = rows * kComponents;
    if (counts[0] > 2ull * reach_ + foreseen_ + 1 || counts[1] > counts[0] ||
        counts[2] != (counts[0] ? countOf(carried) * values : 0))
        throw std::runtime_error("the checkpoint's frames do not fit this bake");
    frames_.assign(counts[0], {});
    middle_ = counts[1];
    for (KeptFrame& frame : frames_) {
        take<std::uint32_t>(bytes, {&frame.index, 1});
        for (const StreamInfo& info : kStreams) {
            if (info.source != StreamSource::motion && !carried[info.id]) continue;
            frame[info.id].resize(values);
            take<float>(bytes, frame[info.id]);
        }
        frame.lifts.resize(lifts * kLiftFloats);
        take<float>(bytes, frame.lifts);
    }
    // What is before the frames may be of another size than it should, and zero.
    if (!bytes.empty()) throw std::runtime_error("the checkpoint's frames do not fit this bake");
}

}  // namespace throng::recording
