// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "shaders/shared/simulation_types.h"
#include "sim/diagram/fixed_squares.h"
#include "sim/gl/buffer.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// How much of the window a build has to bring up to date.
enum class Extent {
    everywhere,
    near_people,  ///< at least what lies under the tiles of moving sites and as far as people look
};

struct VehicleSites;

/// Room for a diagram larger than any texture: squares of PAGE_SIDE px that exist only where a tile reaches.
///
/// A table says for every square of the window where its page stands in the store; place 0 is a page that is
/// always empty and stands for all squares without one, so that a look-up never branches. Pages are placed
/// anew in every build, on the device: all under the tiles of moving sites, and those under fixed ones that
/// somebody looks at, or, for pictures, all of these, too. There are always enough: the store is sized for
/// the most pages that the given number of tiles can touch, or for the whole window where that is less.
class Pages {
  public:
    /// @param live_capacity moving sites; @param largest_radius, @param look px
    /// @param vehicles null: there are none
    /// @throws GraphicsError where the store would be larger than the device can address, saying so
    Pages(const gl::ShaderLibrary& library, std::uint32_t width, std::uint32_t height, float largest_radius,
          float look, std::uint32_t live_capacity, std::span<const gpu::DiagramSite> fixed_sites,
          const VehicleSites* vehicles = nullptr);
    void connect(const gl::Buffer& sites, const gl::Buffer& live_dispatch);

    /// The most pages that so many tiles touch, plus the empty one.
    static std::uint64_t pagesNeeded(std::uint32_t width, std::uint32_t height, float largest_radius,
                                     std::uint64_t sites);

    /// Places the pages for where the sites are now.
    void place(Extent extent);

    std::uint32_t perLine() const { return fixed_.per_line; }
    std::uint32_t capacity() const { return capacity_; }
    /// Where fixed sites are that the pages were made for: squares by place, and places by square.
    const FixedSquares& fixed() const { return fixed_; }
    const gl::Buffer& fixedTable() const { return fixed_table_; }
    const gl::Buffer& table() const { return table_; }
    const gl::Buffer& list() const { return list_; }
    const gl::Buffer& count() const { return count_; }
    /// Room for the pixels of all pages.
    gl::Room store() const;

  private:
    /// Tiles that cover vehicles, whose pages are placed like people's.
    struct Covers {
        gl::Buffer tiles, dispatch;
        gl::ComputeProgram make;
        std::uint32_t count = 0;
    };
    std::uint64_t coverVehicles(const gl::ShaderLibrary& library, const VehicleSites& vehicles,
                                std::uint32_t width, std::uint32_t height);
    void placeUnder(const gl::Buffer& sites, const gl::Buffer& dispatch, float look);

    FixedSquares fixed_;
    std::uint32_t capacity_ = 0;
    float look_;
    gl::Buffer table_;        // per square of the window: the place of its page
    gl::Buffer fixed_table_;  // the same with the pages of fixed sites only
    gl::Buffer list_;         // per place: the number of the square
    gl::Buffer fixed_list_;
    gl::Buffer count_;  // places taken, after the groups for a pass over them
    gl::Buffer fixed_count_, empty_count_;
    gl::ComputeProgram place_, forget_;
    const gl::Buffer* sites_ = nullptr;
    const gl::Buffer* live_dispatch_ = nullptr;
    std::optional<Covers> covers_;
};

}  // namespace throng::sim
