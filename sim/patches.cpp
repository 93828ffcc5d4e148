// SPDX-License-Identifier: Apache-2.0
#include "sim/patches.h"

namespace throng::sim {
namespace {

const gl::Declaration kPatches = {"avoidance",
                                  {"shaders/motion/patches.comp"},
                                  {"LiveDispatch", "Bodies", "Patches", "PatchPoints", "PreferredVelocities"},
                                  {"PreferredVelocities"}};

}  // namespace

Patches::Patches(const gl::ShaderLibrary& library, const Buffers& buffers, const authoring::Scene& scene)
    : buffers_(buffers),
      patches_(gl::makeBuffer("patches", scene.patches.slow, "patch")),
      points_(gl::makeBuffer("outlines of patches", scene.patches.points, "point of a patch")),
      program_(buffers.connect(library, kPatches)) {
    program_.bind("Patches", patches_);
    program_.bind("PatchPoints", points_);
    program_.set("patch_count", static_cast<std::uint32_t>(scene.patches.slow.size()));
}

void Patches::run(float now) {
    program_.set("now", now);
    program_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
}

}  // namespace throng::sim
