// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "sim/buffers.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// Sorts people into cells and gathers their bodies in that order (counting sort, deterministic).
class CellSort {
  public:
    /// What a diagram built afterwards has for owners: slots to sense with, rows to look at.
    enum class SiteIds { slots, rows };

    CellSort(const gl::ShaderLibrary& library, Buffers& buffers, const gpu::Parameters& parameters);
    void run(SiteIds ids = SiteIds::slots);

  private:
    Buffers& buffers_;
    std::uint32_t rows_;
    std::uint64_t scan_threads_;
    gl::ComputeProgram count_, sum_, scan_, fill_, scatter_, gather_;
};

}  // namespace throng::sim
