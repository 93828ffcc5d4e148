// SPDX-License-Identifier: Apache-2.0
#include "io/crowd_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace throng::io {

std::span<const float> CrowdFrame::read(Stream stream) const {
    std::vector<float> values(rows() * kComponents);
    held_->streams[stream].readFrame(held_->index, values);
    return held_->values[stream] = std::move(values);
}

Capsule CrowdFrame::body(std::size_t row, const AgentRow& person) const {
    const double size = this->size(row);
    if (person.body.isDisc()) return {place(row), glm::dvec2(0.0), size * double{person.radius}};
    const bool is_told = held_->streams.has(Stream::chest);
    const double twist = is_told ? static_cast<double>((*this)[Stream::chest][row * kComponents]) : 0.0;
    const glm::dvec2 facing = this->facing(row);
    const glm::dvec2 chest = facing * std::cos(twist) + glm::dvec2(-facing.y, facing.x) * std::sin(twist);
    return capsuleOf(place(row), chest, size * person.body.radius(), size * person.body.halfAxis());
}

CrowdReader::CrowdReader(Bake bake)
    : bake_(std::move(bake)),
      streams_(bake_.folder, bake_.streams, bake_.formats, bake_.frames, bake_.agents) {}

CrowdFrame CrowdReader::frame(std::uint32_t index) {
    if (index >= bake_.frames)
        throw std::out_of_range(fmt::format("there is no frame {} in a bake of {}", index, bake_.frames));
    const auto known = std::ranges::find(kept_, index, [](const auto& held) { return held->index; });
    if (known != kept_.end()) {
        std::rotate(known, known + 1, kept_.end());
        return CrowdFrame(kept_.back());
    }
    if (kept_.size() >= most_kept_) kept_.erase(kept_.begin());
    kept_.push_back(std::make_shared<CrowdFrame::Held>(CrowdFrame::Held{streams_, index, {}}));
    return CrowdFrame(kept_.back());
}

const std::vector<AgentRow>& CrowdReader::people() {
    if (!people_) people_ = loadAgentRows(bake_);
    return *people_;
}

}  // namespace throng::io
