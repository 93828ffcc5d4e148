// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "shaders/shared/simulation_types.h"

namespace throng::sim {

/// Counts what people look at of a diagram, as pages of PAGE_SIDE px (shaders/diagram/pages_near.comp): a
/// crowd in streets looks at much less than as many people who stand apart.
class LookedAtCount {
  public:
    /// @param look px: how far people look
    LookedAtCount(const gpu::Parameters& parameters, double look);

    void begin();
    /// @param place m, of somebody who is there
    void add(glm::vec2 place);
    /// Since begin().
    double pixels() const;

  private:
    gpu::Parameters parameters_;
    double look_;
    std::uint32_t per_line_;
    std::vector<std::uint32_t> stamps_;  // per page, when it was last counted
    std::uint32_t stamp_ = 0;
    std::size_t pages_ = 0;
};

}  // namespace throng::sim
