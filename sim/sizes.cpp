// SPDX-License-Identifier: Apache-2.0
#include "sim/sizes.h"

namespace throng::sim {
namespace {

const gl::Declaration kGrow = {
    "sizes",
    {"shaders/motion/sizes.comp"},
    {"ParametersBlock", "LiveDispatch", "Bodies", "Walkers", "StripStarts", "CellOffsets", "WallSegments",
     "WallStarts", "WallItems", "Patches", "PatchPoints", "People", "Chests"},
    {"People", "Chests"}};
const gl::Declaration kTake = {"sizes",
                               {"shaders/motion/take_sizes.comp"},
                               {"ParametersBlock", "LiveDispatch", "People", "Bodies", "Walkers"},
                               {"Bodies", "Walkers", "Sites"}};

}  // namespace

Sizes::Sizes(const gl::ShaderLibrary& library, const Buffers& buffers, const authoring::Scene& scene)
    : buffers_(buffers),
      patches_(gl::makeBuffer("patches with a size", scene.patches.sized, "patch")),
      points_(gl::makeBuffer("outlines of patches", scene.patches.points, "point of a patch")),
      grow_(buffers.connect(library, kGrow, buffers.definitions())),
      take_(buffers.connect(library, kTake, buffers.definitions())) {
    grow_.bind("Patches", patches_);
    grow_.bind("PatchPoints", points_);
    grow_.set("patch_count", static_cast<std::uint32_t>(scene.patches.sized.size()));
}

void Sizes::run(float now) {
    grow_.set("now", now);
    grow_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
    take_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
}

}  // namespace throng::sim
