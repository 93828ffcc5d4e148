// SPDX-License-Identifier: Apache-2.0
#include "sim/kept_decision.h"

namespace throng::sim {

KeptDecision::KeptDecision(Buffers& b)
    : sorted_{&b.strip_counts, &b.strip_marks, &b.strip_starts,  &b.strip_list, &b.strip_list_end,
              &b.cell_offsets, &b.row_cells,   &b.live_dispatch, &b.site_slots, &b.bodies,
              &b.walkers,      &b.touch_slots, &b.touch_dispatch},
      decided_{&b.touch_words, &b.touch_lists, &b.preferred_velocities, &b.decisions} {
    if (!b.hasCharts()) return;
    sorted_.push_back(&b.slot_images);
    sorted_.push_back(&b.row_slots);
}

void KeptDecision::putAside() {
    if (is_aside_) return;  // two pictures of a moment
    if (aside_.empty())
        for (const gl::Buffer* buffer : sorted_)
            aside_.emplace_back(buffer->contents()->name + ", put aside", buffer->bytes());
    for (std::size_t i = 0; i < sorted_.size(); ++i)
        aside_[i].copyFrom(*sorted_[i]);
    is_aside_ = true;
}

void KeptDecision::takeBack() {
    if (!is_aside_) return;
    for (std::size_t i = 0; i < sorted_.size(); ++i)
        sorted_[i]->copyFrom(aside_[i]);
    is_aside_ = false;
}

std::vector<std::pair<std::string, gl::Buffer*>> KeptDecision::parts() const {
    std::vector<std::pair<std::string, gl::Buffer*>> found;
    for (const auto& buffers : {sorted_, decided_})
        for (gl::Buffer* buffer : buffers)
            found.emplace_back(buffer->contents()->name, buffer);
    return found;
}

}  // namespace throng::sim
