// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/diagram.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "sim/diagram/bands.h"
#include "sim/diagram/methods.h"
#include "sim/gl/context.h"

namespace throng::sim {
namespace {

const gl::Declaration kFlatten = {
    "pictures", {"shaders/diagram/flatten.comp"}, {"owners", "page_table"}, {"WholeOwners"}};
const gl::Declaration kMeasure = {"pictures",
                                  {"shaders/diagram/measure.comp"},
                                  {"Owners", "Sites", "SiteSlots", "VehicleBoxes"},
                                  {"Distances"}};
const gl::Declaration kFindSeconds = {
    "pictures",
    {"shaders/diagram/second.comp"},
    {"Owners", "BinStarts", "binned_sites", "FixedBinStarts", "fixed_binned_sites"},
    {"Seconds"}};
const gl::Declaration kCountLookedUp = {"densities",
                                        {"shaders/diagram/count.comp"},
                                        {"LiveDispatch", "Bands", "Sites", "owners", "page_table"},
                                        {"PixelCounts"}};

/// One word a pixel.
gl::Room picture(const DiagramOptions& options) {
    return {std::size_t{options.width} * options.height, 4, "pixel"};
}

/// One word a pixel that is kept.
gl::Room keptOf(const DiagramOptions& options) {
    if (!options.bands.areUsed()) return picture(options);
    return {std::size_t{options.width} * options.bands.lines(options.look), 4, "pixel of a band"};
}

glm::uvec2 sizeOf(const DiagramOptions& options) {
    return {options.width, options.height};
}

}  // namespace

/// Passes and buffers that only some users of a diagram ask for: made at the first asking.
struct Diagram::Extras {
    struct WholeOwners {
        gl::Buffer owners;
        gl::ComputeProgram flatten;
        bool known = false;  // since the last build
    };
    struct Distances {
        gl::Buffer distances;
        gl::ComputeProgram measure;
    };
    struct Seconds {
        BinGrid grid;
        SiteBins bins;
        std::optional<FixedBins> fixed_bins;
        gl::Buffer seconds;
        gl::ComputeProgram find;
    };
    struct Counts {
        gl::Buffer counts;
        gl::ComputeProgram count;
    };
    std::optional<WholeOwners> whole;
    std::optional<Distances> distances;
    std::optional<Seconds> seconds;
    std::optional<Counts> counts;
};

Diagram::Diagram(const gl::ShaderLibrary& library, const DiagramOptions& options,
                 std::span<const gpu::DiagramSite> fixed_sites)
    : library_(library),
      options_(options),
      fixed_sites_(fixed_sites.begin(), fixed_sites.end()),
      long_work_(std::make_unique<LongWork>()),
      extras_(std::make_unique<Extras>()) {
    if (options_.bands.areUsed() && (options_.paged || options_.vehicles))
        throw std::logic_error("a diagram in bands has neither pages nor vehicles");
    if (options_.paged) {
        if (options_.method != DiagramMethod::binned)
            throw gl::GraphicsError(fmt::format(
                "the method {} needs the whole diagram of {} x {} px in one texture, which is too large. "
                "Use the method binned, which keeps only the parts with people or walls.",
                authoring::wordFor(options_.method), options_.width, options_.height));
        pages_ = std::make_unique<Pages>(library, options_.width, options_.height, options_.largest_radius,
                                         options_.look, options_.live_capacity, fixed_sites_,
                                         options_.vehicles ? &*options_.vehicles : nullptr);
        owners_ = std::make_unique<gl::Buffer>("diagram pages", pages_->store(), gl::Buffer::Use::in_ranges);
        table_texture_ = gl::WordTexture(pages_->table());
    } else {
        owners_ = std::make_unique<gl::Buffer>("diagram owners", keptOf(options_));
    }
    owners_->fill(gpu::NO_INDEX);
    owner_texture_ = gl::WordTexture(*owners_);
    if (options_.vehicles)
        vehicle_cells_.emplace(library, *options_.vehicles, sizeOf(options_), *owners_, pages_.get());
    use(options_.method, options_.gather);
}

Diagram::~Diagram() = default;
Diagram::Diagram(Diagram&&) noexcept = default;
Diagram& Diagram::operator=(Diagram&&) noexcept = default;

/// Pages stand where fixed sites may ever be: which are there now changes what is in their layers.
std::unique_ptr<SparseLayers> Diagram::makeSparseLayers() const {
    if (pages_)
        return std::make_unique<SparseLayers>(library_, options_, pages_->fixed(), &pages_->fixedTable(),
                                              fixed_sites_);
    const FixedSquares squares(options_.width, options_.height, fixed_sites_);
    return std::make_unique<SparseLayers>(library_, options_, squares, nullptr, fixed_sites_);
}

std::unique_ptr<Diagram::Implementation> Diagram::make() {
    DiagramSetup setup{library_, options_, fixed_sites_, *owners_, *long_work_};
    setup.fixed = [&]() -> const FixedLayers& {
        if (!fixed_layers_) fixed_layers_ = std::make_unique<FixedLayers>(setup);
        return *fixed_layers_;
    };
    setup.sparse = [&]() -> const SparseLayers& {
        if (!sparse_layers_) sparse_layers_ = makeSparseLayers();
        return *sparse_layers_;
    };
    switch (options_.method) {
        case DiagramMethod::cones:
            return std::make_unique<ConesDiagram>(setup);
        case DiagramMethod::gradient1:
            return std::make_unique<GradientDiagram>(setup);
        case DiagramMethod::gradient2:
            return std::make_unique<BlendedDiagram>(setup, false);
        case DiagramMethod::gradient2_packed:
            return std::make_unique<BlendedDiagram>(setup, true);
        case DiagramMethod::per_pixel:
            return std::make_unique<PerPixelDiagram>(setup);
        case DiagramMethod::per_site:
            return std::make_unique<PerSiteDiagram>(setup);
        case DiagramMethod::jfa:
            return std::make_unique<FloodDiagram>(setup, FloodVariant{});
        case DiagramMethod::jfa_one_before:
            return std::make_unique<FloodDiagram>(setup, FloodVariant{true, false, false});
        case DiagramMethod::jfa_one_after:
            return std::make_unique<FloodDiagram>(setup, FloodVariant{false, true, false});
        case DiagramMethod::jfa_from_radius:
            return std::make_unique<FloodDiagram>(setup, FloodVariant{false, false, true});
        case DiagramMethod::binned:
            return std::make_unique<BinnedDiagram>(setup, pages_.get());
        case DiagramMethod::automatic:
            break;
    }
    throw std::logic_error("a diagram needs a method that has been chosen");
}

void Diagram::use(DiagramMethod method, const GatherShape& gather) {
    if ((options_.paged || options_.bands.areUsed()) && method != DiagramMethod::binned)
        throw std::logic_error("a diagram that is not kept whole has one method");
    options_.method = method;
    options_.gather = gather;
    auto known = std::find_if(made_.begin(), made_.end(), [&](const Made& made) {
        return made.method == method && (method != DiagramMethod::binned || made.gather == gather);
    });
    if (known == made_.end()) {
        made_.push_back({method, gather, make()});
        known = std::prev(made_.end());
        if (input_.sites) known->implementation->connect(input_);
    }
    current_ = known->implementation.get();
}

void Diagram::connect(const DiagramInput& input) {
    input_ = input;
    if (options_.bands.areUsed()) bands_ = std::make_unique<Bands>(library_, options_, input_);
    for (Made& made : made_)
        made.implementation->connect(input);
    if (vehicle_cells_) vehicle_cells_->connect(*input.sites, *input.site_slots);
    extras_ = std::make_unique<Extras>();
}

void Diagram::changeFixedSites(std::span<const gpu::DiagramSite> fixed_sites) {
    if (fixed_sites.size() != fixed_sites_.size())
        throw std::logic_error("the number of fixed sites cannot change");
    fixed_sites_.assign(fixed_sites.begin(), fixed_sites.end());
    made_.clear();
    fixed_layers_.reset();
    sparse_layers_.reset();
    use(options_.method, options_.gather);
    extras_ = std::make_unique<Extras>();
}

void Diagram::Implementation::buildBand(const Bands&, std::uint32_t, Extent) {
    throw std::logic_error("not a way to build diagrams in bands");
}

bool Diagram::build(Extent extent) {
    if (bands_) bands_->findSlots();
    extent_ = extent;
    if (extras_->whole) extras_->whole->known = false;
    long_work_->stopped = false;
    current_->build(extent);
    if (vehicle_cells_) vehicle_cells_->run();
    return !long_work_->stopped;
}

void Diagram::buildBand(std::uint32_t band, Extent extent) {
    if (!bands_) throw std::logic_error("this diagram is not in bands, or not connected");
    current_->buildBand(*bands_, band, extent);
}

gl::Definitions Diagram::lookupDefinitions() const {
    if (options_.bands.areUsed()) return {{"BANDED", "1"}};
    return options_.paged ? gl::Definitions{{"PAGED", "1"}} : gl::Definitions{};
}

void Diagram::describeTo(gl::Program& program) const {
    program.bind("owners", owner_texture_);
    program.set("owner_line", pages_ ? pages_->perLine() : options_.width);
    if (pages_) program.bind("page_table", table_texture_);
}

void Diagram::lookUpInBand(gl::ComputeProgram& program, std::uint32_t band) const {
    program.set("first_line", bands_->lines(band).x);
    bands_->dispatch(program, band);
}

/// All bands under each other, once for each build.
const gl::Buffer& Diagram::assembleBands() {
    if (!extras_->whole) {
        extras_->whole = Extras::WholeOwners{};
        extras_->whole->owners = gl::Buffer("diagram owners, whole", picture(options_));
    }
    if (extras_->whole->known) return extras_->whole->owners;
    const std::size_t line_bytes = std::size_t{options_.width} * gl::kWord;
    for (std::uint32_t band = 0; band < bands_->count(); ++band) {
        buildBand(band);
        const glm::uvec2 lines = bands_->lines(band);
        extras_->whole->owners.copyFrom(*owners_, lines.x * line_bytes, (lines.y - lines.x) * line_bytes);
    }
    extras_->whole->known = true;
    return extras_->whole->owners;
}

const gl::Buffer& Diagram::wholeOwners() {
    if (bands_) return assembleBands();
    if (!options_.paged) return *owners_;
    if (!extras_->whole) {
        extras_->whole = Extras::WholeOwners{};
        extras_->whole->owners = gl::Buffer("diagram owners, whole", picture(options_));
        gl::ComputeProgram& flatten = extras_->whole->flatten;
        flatten = gl::ComputeProgram(library_, kFlatten, lookupDefinitions());
        flatten.bind("WholeOwners", extras_->whole->owners);
        flatten.set("diagram_size", sizeOf(options_));
        describeTo(flatten);
    }
    extras_->whole->flatten.dispatch(std::uint64_t{options_.width} * options_.height);
    return extras_->whole->owners;
}

const gl::Buffer& Diagram::measureDistances() {
    const gl::Buffer& owners = wholeOwners();
    if (!extras_->distances) {
        extras_->distances.emplace();
        extras_->distances->distances = gl::Buffer("diagram distances", picture(options_));
        gl::ComputeProgram& measure = extras_->distances->measure;
        measure = gl::ComputeProgram(library_, kMeasure,
                                     options_.vehicles ? options_.vehicles->definitions : gl::Definitions{});
        if (options_.vehicles) options_.vehicles->describeTo(measure);
        measure.bind("Owners", owners);
        measure.bind("Sites", *input_.sites);
        measure.bind("SiteSlots", *input_.site_slots);
        measure.bind("Distances", extras_->distances->distances);
        measure.set("diagram_size", sizeOf(options_));
    }
    extras_->distances->measure.dispatch(std::uint64_t{options_.width} * options_.height);
    return extras_->distances->distances;
}

const gl::Buffer& Diagram::findSeconds() {
    const gl::Buffer& owners = wholeOwners();
    if (!extras_->seconds) {
        const BinGrid grid(options_.width, options_.height, std::max(1.0f, options_.largest_radius));
        extras_->seconds.emplace(
            Extras::Seconds{grid, SiteBins(library_, grid, options_.live_capacity), {}, {}, {}});
        Extras::Seconds& seconds = *extras_->seconds;
        seconds.bins.connect(*input_.sites, *input_.live_dispatch);
        seconds.seconds = gl::Buffer("second owners", picture(options_));
        gl::Definitions definitions;
        if (!fixed_sites_.empty()) {
            seconds.fixed_bins.emplace(library_, grid, fixed_sites_);
            definitions.emplace_back("FIXED_SITES", "1");
        }
        seconds.find = gl::ComputeProgram(library_, kFindSeconds, definitions);
        grid.describeTo(seconds.find);
        seconds.find.bind("Owners", owners);
        seconds.find.bind("Seconds", seconds.seconds);
        seconds.find.bind("BinStarts", seconds.bins.starts());
        seconds.find.bind("binned_sites", seconds.bins.sites());
        seconds.find.set("diagram_size", sizeOf(options_));
        seconds.find.set("largest_radius", options_.largest_radius + 0.01f);
        if (seconds.fixed_bins) {
            seconds.find.bind("FixedBinStarts", seconds.fixed_bins->starts());
            seconds.find.bind("fixed_binned_sites", seconds.fixed_bins->sites());
        }
    }
    extras_->seconds->bins.sort();
    extras_->seconds->find.dispatch(std::uint64_t{options_.width} * options_.height);
    return extras_->seconds->seconds;
}

const gl::Buffer& Diagram::countPixels() {
    if (!extras_->counts) {
        extras_->counts.emplace();
        extras_->counts->counts = gl::Buffer("pixels of each site", {options_.live_capacity, 4, kSite});
        gl::ComputeProgram& count = extras_->counts->count;
        count = gl::ComputeProgram(library_, kCountLookedUp, lookupDefinitions());
        count.bind("Sites", *input_.sites);
        if (!bands_) count.bind("LiveDispatch", *input_.live_dispatch);
        count.bind("PixelCounts", extras_->counts->counts);
        count.set("diagram_size", glm::vec2(options_.width, options_.height));
        describeTo(count);
    }
    extras_->counts->counts.fill(0);
    if (!bands_) extras_->counts->count.dispatchIndirect(*input_.live_dispatch);
    for (std::uint32_t band = 0; bands_ && band < bands_->count(); ++band) {
        buildBand(band, extent_);
        lookUpInBand(extras_->counts->count, band);
    }
    return extras_->counts->counts;
}

}  // namespace throng::sim
