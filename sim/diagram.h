// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "shaders/shared/simulation_types.h"
#include "sim/gl/buffer.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// The truncated Voronoi diagram of the MIG 2013 paper, exact: every pixel's owner is the nearest site whose
/// tile radius reaches the pixel's centre, ties going to the smallest id, and no other.
///
/// Sites are given in pixels of the window. Two ways to build it, chosen by measurement:
///   perSite    compute shaders splat every site's tile, see shaders/diagram_splat.glsl
///   gradient1  point sprites with fragment depth and the depth test (Denny 2003)
class Diagram {
  public:
    enum class Method { per_site, gradient1 };

    /// @param width,height px; @param largest_radius px, of any tile
    /// @param fixed_sites sites that never move (walls), ids above those of all others
    /// @throws GraphicsError when the window or the radius is more than the device can do, saying what would
    /// fit
    Diagram(const gl::ShaderLibrary& library, Method method, std::uint32_t width, std::uint32_t height,
            float largest_radius, std::span<const gpu::DiagramSite> fixed_sites);
    ~Diagram();
    Diagram(Diagram&&) noexcept;
    Diagram& operator=(Diagram&&) noexcept;

    /// What build() reads. `sites` and `live_dispatch` as in shaders/diagram_*.comp; `draw_order` lists, by
    /// ascending id, where a site stands in `sites` (NO_INDEX: not there); only gradient1 needs it.
    struct Input {
        const gl::Buffer* sites = nullptr;
        const gl::Buffer* live_dispatch = nullptr;
        const gl::Buffer* draw_order = nullptr;
        std::uint32_t draw_count = 0;
    };
    /// Buffers are bound once; they must stay alive and in place.
    void connect(const Input& input);

    void build();
    /// Also fills distances() where the method does not do so on its own.
    void buildWithDistances();

    /// Per pixel, bottom row first: the owner's id, NO_INDEX where there is none.
    const gl::Buffer& owners() const;
    /// Per pixel: float; times distanceScale() it is the squared distance in px^2. Undefined where there is
    /// no owner.
    const gl::Buffer& distances() const;
    float distanceScale() const;

    std::uint32_t width() const;
    std::uint32_t height() const;
    Method method() const;

    struct Implementation;

  private:
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace throng::sim
