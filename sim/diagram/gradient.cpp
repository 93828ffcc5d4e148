// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "sim/diagram/methods.h"

namespace throng::sim {
namespace {

const gl::Declaration kNearest = {"diagram",
                                  {"shaders/diagram/gradient.vert", "shaders/diagram/gradient.frag"},
                                  {"Sites", "SiteSlots"},
                                  {}};
const gl::Declaration kBlend = {"diagram",
                                {"shaders/diagram/gradient.vert", "shaders/diagram/blend.frag"},
                                {"Sites", "SiteSlots", "smallest_distance"},
                                {}};
const gl::Declaration kDecode = {"diagram", {"shaders/diagram/blend_decode.comp"}, {"Keys"}, {"Owners"}};
const gl::Declaration kCones = {
    "diagram", {"shaders/diagram/cones.vert", "shaders/diagram/cones.frag"}, {"Sites", "SiteSlots"}, {}};

std::uint32_t marginFor(float radius) {
    return static_cast<std::uint32_t>(std::ceil(radius)) + 2;
}

float spriteSize(float radius) {
    return 2.0f * radius + 1.0f;
}

}  // namespace

GradientDiagram::GradientDiagram(const DiagramSetup& setup)
    : target_("gradient1", gl::RasterTarget::Kind::unsigned_nearest, setup.options.width,
              setup.options.height, marginFor(setup.options.largest_radius)),
      program_(setup.library, kNearest),
      draw_count_(setup.siteCount()),
      owners_(setup.owners) {
    const float radius = setup.options.largest_radius;
    gl::RasterTarget::requirePointSize("gradient1", spriteSize(radius));
    program_.set("target_size", target_.size());
    program_.set("margin", static_cast<float>(target_.margin()));
    // A power of two above every squared distance keeps depth within [0, 1] without rounding it.
    program_.set("depth_scale", 1.0f / std::exp2(std::ceil(std::log2(radius * radius)) + 1.0f));
}

void GradientDiagram::connect(const DiagramInput& input) {
    program_.bind("Sites", *input.sites);
    program_.bind("SiteSlots", *input.site_slots);
}

void GradientDiagram::draw() {
    target_.clear();
    target_.drawPoints(program_, draw_count_);
}

void GradientDiagram::build(Extent) {
    draw();
    target_.readInto(owners_);
}

namespace {

gl::Program blendProgram(const DiagramSetup& setup, const gl::RasterTarget& target, const char* pass) {
    gl::Program program(setup.library, kBlend, {{pass, "1"}});
    program.set("target_size", target.size());
    program.set("margin", static_cast<float>(target.margin()));
    return program;
}

gl::RasterTarget blendTarget(const DiagramSetup& setup) {
    return {"gradient2", gl::RasterTarget::Kind::float_minimum, setup.options.width, setup.options.height,
            marginFor(setup.options.largest_radius)};
}

std::uint32_t bitsFor(std::uint32_t count) {
    std::uint32_t bits = 1;
    while (bits < 31 && (std::uint64_t{1} << bits) < count)
        ++bits;
    return bits;
}

}  // namespace

BlendedDiagram::BlendedDiagram(const DiagramSetup& setup, bool packed)
    : first_target_(blendTarget(setup)),
      first_(blendProgram(setup, first_target_, packed ? "BLEND_PACKED" : "BLEND_DISTANCE")),
      draw_count_(setup.siteCount()),
      pixels_(std::uint64_t{setup.options.width} * setup.options.height),
      keys_("blended keys", {pixels_, 4, "pixel"}),
      decode_(setup.library, kDecode) {
    const float radius = setup.options.largest_radius;
    gl::RasterTarget::requirePointSize("gradient2", spriteSize(radius));
    const std::uint32_t id_bits = bitsFor(setup.siteCount());
    if (packed) {
        // What is left between the smallest normal float and infinity is just under 31 bits.
        constexpr std::uint32_t kKeyBits = 30;
        const auto steps = static_cast<float>((1u << (kKeyBits - id_bits)) - 1);
        first_.set("distance_steps", steps / (radius * radius * 1.0001f));
        first_.set("id_bits", id_bits);
    } else {
        second_target_.emplace(blendTarget(setup));
        second_.emplace(blendProgram(setup, *second_target_, "BLEND_SITE"));
        second_->bindTexture("smallest_distance", first_target_.texture(), first_target_.contents());
    }
    decode_.bind("Keys", keys_);
    decode_.bind("Owners", setup.owners);
    decode_.set("pixel_count", static_cast<std::uint32_t>(pixels_));
    decode_.set("id_mask", packed ? (1u << id_bits) - 1u : 0xffffffffu);
    decode_.set("nobody", 3.0e38f);
}

void BlendedDiagram::connect(const DiagramInput& input) {
    for (gl::Program* program : {&first_, second_ ? &*second_ : nullptr}) {
        if (!program) continue;
        program->bind("Sites", *input.sites);
        program->bind("SiteSlots", *input.site_slots);
    }
}

void BlendedDiagram::build(Extent) {
    first_target_.clear();
    first_target_.drawPoints(first_, draw_count_);
    if (second_) {
        second_target_->clear();
        second_target_->drawPoints(*second_, draw_count_);
    }
    (second_ ? *second_target_ : first_target_).readInto(keys_);
    decode_.dispatch(pixels_);
}

ConesDiagram::ConesDiagram(const DiagramSetup& setup)
    : target_("cones", gl::RasterTarget::Kind::unsigned_nearest, setup.options.width, setup.options.height,
              marginFor(setup.options.largest_radius)),
      program_(setup.library, kCones),
      sides_(setup.options.cone_sides),
      draw_count_(setup.siteCount()),
      owners_(setup.owners) {
    const float rim =
        (setup.options.largest_radius + 1.0f) / std::cos(3.14159265f / static_cast<float>(sides_));
    program_.set("target_size", target_.size());
    program_.set("margin", static_cast<float>(target_.margin()));
    program_.set("depth_scale", 1.0f / (rim * 1.01f));
    program_.set("sides", sides_);
}

void ConesDiagram::connect(const DiagramInput& input) {
    program_.bind("Sites", *input.sites);
    program_.bind("SiteSlots", *input.site_slots);
}

void ConesDiagram::build(Extent) {
    target_.clear();
    target_.drawTriangles(program_, 3 * sides_, draw_count_);
    target_.readInto(owners_);
}

}  // namespace throng::sim
