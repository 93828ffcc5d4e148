// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/buffers.h"

namespace throng::sim {

/// What a decision leaves for the steps until the next one: the slots that people have, their lists, and what
/// they decided. A picture between two decisions brings people into the order of the moment, so it puts aside
/// what the steps after it go on with: pictures change nobody's motion.
class KeptDecision {
  public:
    /// @param buffers stay where they are
    explicit KeptDecision(Buffers& buffers);

    /// Before people are sorted for a picture.
    void putAside();
    /// Nothing where nothing was put aside.
    void takeBack();
    /// A decision made anew needs nothing of it.
    void forget() { is_aside_ = false; }

    /// By name: what a simulation has to be given that goes on between two decisions.
    std::vector<std::pair<std::string, gl::Buffer*>> parts() const;

  private:
    std::vector<gl::Buffer*> sorted_;   // what sorting people overwrites
    std::vector<gl::Buffer*> decided_;  // what it leaves alone
    std::vector<gl::Buffer> aside_;     // of sorted_; made when first needed
    bool is_aside_ = false;
};

}  // namespace throng::sim
