// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "authoring/diagram_method.h"
#include "shaders/shared/simulation_types.h"
#include "sim/diagram/pages.h"
#include "sim/diagram/site_bins.h"
#include "sim/diagram/vehicle_cells.h"
#include "sim/gl/buffer.h"
#include "sim/gl/program.h"

namespace throng::sim {

using authoring::DiagramMethod;

/// How the gathering method cuts its work; all give the same diagram.
struct GatherShape {
    std::uint32_t block_width = 8;   ///< px that an invocation keeps in registers
    std::uint32_t block_height = 4;  ///< px
    float bin_radii = 1.5f;          ///< side of a bin in largest radii

    bool operator==(const GatherShape&) const = default;
};

/// How a diagram is cut of which one band of lines is kept at a time: sim/diagram/bands.h.
struct BandShape {
    std::uint32_t bin_lines = 0;  ///< lines of the bins that sites come sorted by; 0: it is kept whole
    float bin_side = 0.0f;        ///< px, of these bins

    bool areUsed() const { return bin_lines > 0; }
    /// px: how many lines are kept. @param look px: how far people look
    std::uint32_t lines(float look) const;
};

/// Where diagrams are built and how.
struct DiagramOptions {
    DiagramMethod method = DiagramMethod::binned;  ///< not `automatic`: whoever makes a diagram has chosen
    std::uint32_t width = 0;                       ///< px
    std::uint32_t height = 0;                      ///< px
    float largest_radius = 1.0f;                   ///< px, of any tile
    std::uint32_t live_capacity = 0;               ///< sites that move, at most
    std::uint32_t cone_sides = 16;                 ///< [3, 256], cones only
    GatherShape gather;                            ///< binned only
    float look = 0.0f;                             ///< px: how far from moving sites owners are looked up
    bool paged = false;                            ///< kept page by page (sim/diagram/pages.h); binned only
    BandShape bands = {};                          ///< not with pages or vehicles; binned only
    std::optional<VehicleSites> vehicles = {};     ///< that are laid over it
};

/// What every diagram reads; the buffers must stay alive and in place.
struct DiagramInput {
    /// Sites in pixels of the window: those that move first, in any order, the fixed ones after
    /// `live_capacity`.
    const gl::Buffer* sites = nullptr;
    /// The block LiveDispatch of the shaders: how many move, and the groups for a pass over them.
    const gl::Buffer* live_dispatch = nullptr;
    /// By ascending id, where a site stands in `sites`; NO_INDEX: not there.
    const gl::Buffer* site_slots = nullptr;
    /// Where the moving sites already stand in the order of some bins, those bins: it saves sorting them
    /// again.
    struct Sorted {
        const gl::Buffer* strip_starts = nullptr;  ///< per strip of bins (shaders/cells/cell_starts.glsl)
        const gl::Buffer* starts = nullptr;        ///< per bin, within its strip, and one more
        BinGrid grid;
    };
    std::optional<Sorted> sorted = {};
};

/// Builds that take seconds are cut into pieces, so that somebody may put an end to them.
struct LongWork {
    std::function<bool()> stop;  ///< asked between two pieces, if there is anything to ask
    bool in_pieces = false;      ///< whether there is more than one
    bool stopped = false;        ///< the last build: its result is not complete
};

class Bands;
class FixedLayers;
class SparseLayers;

/// The truncated Voronoi diagram of De Gyves, Toledo and Rudomin 2013: every pixel's owner is the nearest
/// site whose tile radius reaches the pixel's centre, ties going to the smallest id, and no other. Vehicles
/// are sites with an outline in place of a centre.
class Diagram {
  public:
    /// @param fixed_sites sites that never move (walls), ids above those of all others
    /// @throws GraphicsError when the window or the radius is more than the device can do, saying what would
    /// fit
    Diagram(const gl::ShaderLibrary& library, const DiagramOptions& options,
            std::span<const gpu::DiagramSite> fixed_sites);
    ~Diagram();
    Diagram(Diagram&&) noexcept;
    Diagram& operator=(Diagram&&) noexcept;

    void connect(const DiagramInput& input);

    /// As many fixed sites as before, elsewhere or of other sizes. Those in the sites' buffer are the
    /// caller's business.
    void changeFixedSites(std::span<const gpu::DiagramSite> fixed_sites);

    /// Goes on with another way to build it; the result stays in the same buffer. Not while paged.
    void use(DiagramMethod method, const GatherShape& gather = {});
    DiagramMethod method() const { return options_.method; }

    /// @returns false where the build was stopped: the owners are then of no use
    bool build(Extent extent = Extent::everywhere);
    /// Null: it is kept whole, or in pages. Otherwise there are owners to look up after build() and then
    /// buildBand() only, for those who stand in this band.
    const Bands* bands() const { return bands_.get(); }
    void buildBand(std::uint32_t band, Extent extent = Extent::everywhere);
    /// @param stop tells whether to put an end to a build that takes long; null: nobody does
    void stopWhen(std::function<bool()> stop) { long_work_->stop = std::move(stop); }

    bool buildsInPieces() const { return long_work_->in_pieces; }

    /// The owners' ids, NO_INDEX where there is none: per pixel, bottom row first, or a store of pages.
    const gl::Buffer& owners() const { return *owners_; }
    /// Makes a program with shaders/diagram/owners.glsl look up owners here.
    void describeTo(gl::Program& program) const;
    /// Runs such a program over those who stand in the band that has been built.
    void lookUpInBand(gl::ComputeProgram& program, std::uint32_t band) const;
    /// What such a program has to be compiled with.
    gl::Definitions lookupDefinitions() const;
    /// The id of the first vehicle: those of all sites are below it.
    std::uint32_t firstVehicle() const {
        return options_.vehicles ? options_.vehicles->first_id : gpu::NO_INDEX;
    }
    bool paged() const { return options_.paged; }

    /// What may be asked of a built diagram; each call works from the owners as they are. Of one in bands,
    /// from the sites as they are: ask before they are sorted anew. The owners as one picture, whether paged
    /// or in bands or not.
    const gl::Buffer& wholeOwners();
    /// Squared distances to the owners, float, px^2; infinite where there is no owner.
    const gl::Buffer& measureDistances();
    /// The second-nearest site whose tile reaches the pixel (Sud et al. 2007), ties to the smallest id,
    /// NO_INDEX where there is none. Exact if the owners are.
    const gl::Buffer& findSeconds();
    /// Pixels owned by each of the first `live_capacity` ids, unsigned.
    const gl::Buffer& countPixels();

    std::uint32_t width() const { return options_.width; }
    std::uint32_t height() const { return options_.height; }

    /// One way to build a diagram.
    struct Implementation {
        virtual ~Implementation() = default;
        virtual void connect(const DiagramInput& input) = 0;
        virtual void build(Extent extent) = 0;
        /// Of a diagram in bands: one of them, after build(), which then makes ready for all.
        virtual void buildBand(const Bands& bands, std::uint32_t band, Extent extent);
    };

  private:
    struct Extras;
    std::unique_ptr<Implementation> make();
    std::unique_ptr<SparseLayers> makeSparseLayers() const;
    const gl::Buffer& assembleBands();

    gl::ShaderLibrary library_;
    DiagramOptions options_;
    std::vector<gpu::DiagramSite> fixed_sites_;
    std::unique_ptr<LongWork> long_work_;
    std::unique_ptr<Pages> pages_;
    std::unique_ptr<Bands> bands_;
    Extent extent_ = Extent::everywhere;  // of the last build
    std::unique_ptr<FixedLayers> fixed_layers_;
    std::unique_ptr<SparseLayers> sparse_layers_;
    std::optional<VehicleCells> vehicle_cells_;
    std::unique_ptr<gl::Buffer> owners_;  // in one place for good: others bind it
    gl::WordTexture owner_texture_, table_texture_;
    struct Made {
        DiagramMethod method;
        GatherShape gather;
        std::unique_ptr<Implementation> implementation;
    };
    std::vector<Made> made_;
    Implementation* current_ = nullptr;
    std::unique_ptr<Extras> extras_;
    DiagramInput input_;
};

}  // namespace throng::sim
