// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "sim/diagram/pages.h"
#include "sim/gl/buffer.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// Vehicles as a diagram has them.
struct VehicleSites {
    const gl::Buffer* boxes = nullptr;  ///< gpu::VehicleBox each; half_width 0: it is not there
    gl::Definitions definitions;        ///< TRAFFIC, and how many VEHICLES
    std::uint32_t count = 0;            ///< as VEHICLES says
    std::uint32_t first_id = 0;         ///< above those of all sites
    float reach = 0.0f;                 ///< px: how far from them pixels may be theirs, as a wall's tile
    float longest = 0.0f;               ///< px
    float widest = 0.0f;                ///< px, half
    glm::vec2 minimum{0.0f};            ///< m: the corner of pixel (0, 0)
    float pixels_per_metre = 1.0f;

    /// Sets what shaders/diagram/vehicle_sites.glsl asks for.
    void describeTo(gl::Program& program) const;
    /// Tiles that cover one, wherever it is.
    std::uint32_t tilesOfOne() const;
    /// px: no tile is larger.
    float largestTile() const;
};

/// Lays vehicles over a diagram that has been built, see shaders/diagram/vehicles.comp.
class VehicleCells {
  public:
    /// @param pages null: the owners are one picture
    VehicleCells(const gl::ShaderLibrary& library, const VehicleSites& vehicles, glm::uvec2 size,
                 const gl::Buffer& owners, const Pages* pages);
    void connect(const gl::Buffer& sites, const gl::Buffer& site_slots);
    void run();

  private:
    VehicleSites vehicles_;
    const gl::Buffer* owners_;
    const Pages* pages_;
    gl::WordTexture table_;
    gl::ComputeProgram program_;
};

}  // namespace throng::sim
