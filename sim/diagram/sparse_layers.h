// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "sim/diagram/diagram.h"
#include "sim/diagram/fixed_squares.h"
#include "sim/gl/buffer.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// The diagram of the sites that never move, worked out once, of the squares that they reach: however many
/// walls there are, a build then takes no longer than reading two words a pixel where it writes one, and most
/// of a world has no room for walls to take.
class SparseLayers {
  public:
    /// @param places the squares' places on the device, which outlive this; null: there are none yet
    SparseLayers(const gl::ShaderLibrary& library, const DiagramOptions& options, const FixedSquares& squares,
                 const gl::Buffer* places, std::span<const gpu::DiagramSite> fixed_sites);

    /// What shaders/diagram/binned.comp asks for where it has FIXED_LAYERS.
    void describeTo(gl::Program& gather) const;

    /// Bytes on the device, those of places among them.
    static std::size_t bytes(const FixedSquares& squares);

  private:
    void work(const gl::ShaderLibrary& library, const DiagramOptions& options, const FixedSquares& squares,
              std::span<const gpu::DiagramSite> fixed_sites);

    std::uint32_t per_line_;
    gl::Buffer own_places_;
    const gl::Buffer* places_;  // null: its own
    gl::Buffer layers_;         // per pixel of the store: whose it is, and the squared distance as bits
    gl::WordTexture texture_;
};

}  // namespace throng::sim
