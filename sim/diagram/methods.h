// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "sim/diagram/diagram.h"
#include "sim/diagram/fixed_layers.h"
#include "sim/diagram/pages.h"
#include "sim/diagram/sparse_layers.h"
#include "sim/gl/raster_target.h"

/// The ways to build a diagram. Each leaves the owners in the buffer it was given.
namespace throng::sim {

/// What each of them is made from.
struct DiagramSetup {
    const gl::ShaderLibrary& library;
    const DiagramOptions& options;
    std::span<const gpu::DiagramSite> fixed_sites;
    gl::Buffer& owners;
    LongWork& long_work;
    /// What the fixed sites alone give, everywhere and where they are; each made at the first asking.
    std::function<const FixedLayers&()> fixed = {};
    std::function<const SparseLayers&()> sparse = {};
    /// One word a pixel.
    gl::Room picture() const { return {std::size_t{options.width} * options.height, 4, "pixel"}; }
    std::uint32_t siteCount() const {
        return options.live_capacity + static_cast<std::uint32_t>(fixed_sites.size());
    }
};

/// Every site offers itself to the pixels under its tile, see shaders/diagram/splat.glsl.
class PerSiteDiagram final : public Diagram::Implementation {
  public:
    explicit PerSiteDiagram(const DiagramSetup& setup);
    void connect(const DiagramInput& input) override;
    void build(Extent extent) override;

  private:
    gl::Buffer& owners_;
    gl::Buffer distances_;
    const FixedLayers* fixed_;  // which every build starts from; null: there are no fixed sites
    Splat splat_;
};

/// Every pixel compares all sites, see shaders/diagram/per_pixel.comp.
class PerPixelDiagram final : public Diagram::Implementation {
  public:
    explicit PerPixelDiagram(const DiagramSetup& setup);
    void connect(const DiagramInput& input) override;
    void build(Extent extent) override;

  private:
    std::uint64_t pixels_;
    std::uint64_t pixels_at_a_time_;
    LongWork& long_work_;
    gl::ComputeProgram program_;
    gl::WordTexture sites_;
};

/// What gathers where people look in a picture that is kept whole.
struct BinnedNear {
    gl::Buffer stamps, list, count;
    gl::Buffer none;  // what count starts as
    gl::ComputeProgram list_pages, gather;
    std::uint32_t stamp = 0;
};

/// Sites sorted into bins, blocks of pixels look through the bins near them, see shaders/diagram/binned.comp.
class BinnedDiagram final : public Diagram::Implementation {
  public:
    /// @param pages where the owners are kept page by page; they then hold a store of pages
    BinnedDiagram(const DiagramSetup& setup, Pages* pages);
    void connect(const DiagramInput& input) override;
    void build(Extent extent) override;
    void buildBand(const Bands& bands, std::uint32_t band, Extent extent) override;

  private:
    void setUpPages(const DiagramSetup& setup);
    std::size_t pagesListed() const;
    bool canBuildNear() const;
    void setUpNear();
    void connectNear();
    void connectGather(gl::ComputeProgram& gather);
    void buildPages(Extent extent);
    void beginNear();
    std::uint64_t blocks(std::uint32_t lines) const;

    gl::ShaderLibrary library_;
    DiagramOptions options_;
    std::optional<SiteBins> bins_;  // unless the sites come sorted
    gl::Buffer no_strips_;          // beside bins_
    gl::WordTexture sorted_sites_;  // where the sites do come sorted
    gl::ComputeProgram gather_;
    const SparseLayers* fixed_;       // null: there are no fixed sites
    std::optional<BinnedNear> near_;  // made at the first asking
    DiagramInput input_;
    std::optional<BinGrid> grid_;

    Pages* pages_;
    gl::Buffer& owners_;
    std::uint32_t ranges_ = 0;
    std::uint32_t pages_per_range_ = 0;
    gl::ComputeProgram count_groups_;
    gl::Buffer page_dispatch_;
};

/// Point sprites and the depth test, see shaders/diagram/gradient.frag.
class GradientDiagram final : public Diagram::Implementation {
  public:
    explicit GradientDiagram(const DiagramSetup& setup);
    void connect(const DiagramInput& input) override;
    void build(Extent extent) override;

    /// Draws, and leaves the result in the textures: what benchmarks time as "one gradient1 diagram".
    void draw();

  private:
    gl::RasterTarget target_;
    gl::Program program_;
    std::uint32_t draw_count_;
    const gl::Buffer& owners_;
};

/// Point sprites and blending, see shaders/diagram/blend.frag.
class BlendedDiagram final : public Diagram::Implementation {
  public:
    /// @param packed one pass over a quantised distance and the id, instead of two exact ones
    BlendedDiagram(const DiagramSetup& setup, bool packed);
    void connect(const DiagramInput& input) override;
    void build(Extent extent) override;

  private:
    gl::RasterTarget first_target_;
    gl::Program first_;
    std::optional<gl::RasterTarget> second_target_;  // unless packed
    std::optional<gl::Program> second_;
    std::uint32_t draw_count_;
    std::uint64_t pixels_;
    gl::Buffer keys_;
    gl::ComputeProgram decode_;
};

/// A cone a site and the depth test, see shaders/diagram/cones.vert.
class ConesDiagram final : public Diagram::Implementation {
  public:
    explicit ConesDiagram(const DiagramSetup& setup);
    void connect(const DiagramInput& input) override;
    void build(Extent extent) override;

  private:
    gl::RasterTarget target_;
    gl::Program program_;
    std::uint32_t sides_;
    std::uint32_t draw_count_;
    const gl::Buffer& owners_;
};

/// Which jump flooding, see shaders/diagram/flood_jump.comp.
struct FloodVariant {
    bool one_before = false;
    bool one_after = false;
    bool from_radius = false;
};

class FloodDiagram final : public Diagram::Implementation {
  public:
    FloodDiagram(const DiagramSetup& setup, const FloodVariant& variant);
    void connect(const DiagramInput& input) override;
    void build(Extent extent) override;

  private:
    std::vector<std::uint32_t> steps_;  // px, in the order of the rounds
    std::uint64_t pixels_;
    std::uint32_t site_count_;
    gl::WordTexture site_texture_;
    gl::Buffer seeds_, other_seeds_;
    gl::ComputeProgram seed_, forth_, back_, finish_;
};

}  // namespace throng::sim
