// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "authoring/overrides/overrides_reader.h"
#include "io/overrides/apply_layers.h"
#include "io/overrides/apply_overrides.h"
#include "io/verify_bake.h"
#include "sample_crowd.h"

namespace throng::test {

/// Some rows of a bake with changes, written as another one.
inline std::optional<io::ApplyResult> applyOverrides(io::CrowdReader& reader,
                                                     const std::vector<io::RowChange>& changes,
                                                     const io::ApplyOptions& options) {
    io::LayeredCrowd crowd(reader);
    io::changeRows(crowd, changes);
    return io::writeApplied(crowd, options);
}

/// The layers of a file, of which `layers` is the list.
inline std::vector<authoring::Layer> layersOf(const std::string& layers) {
    authoring::Diagnostics diagnostics;
    const auto file = authoring::readOverrides(
        R"({"throng_overrides": 1, "overrides": [], "layers": )" + layers + "}", diagnostics);
    for (const authoring::Diagnostic& each : diagnostics.entries)
        ADD_FAILURE() << each.message << " at " << each.where.pointer();
    return file ? file->layers : std::vector<authoring::Layer>{};
}

/// A sample bake, what layers do to it, and what is written of that.
class AppliedLayers {
  public:
    explicit AppliedLayers(const std::string& layers, SampleOptions options = {}, bool written = true)
        : crowd(options) {
        crowd.bake(folder_ / "bake");
        source = io::loadBake(folder_ / "bake");
        io::CrowdReader reader(source);
        io::LayeredCrowd layered(reader);
        results = io::applyLayers(layered, layersOf(layers), io::loadEntrants(reader));
        if (!written) return;
        io::ApplyOptions apply;
        apply.output = folder_ / "applied";
        apply.watch_overlaps = true;
        apply.gltf = true;
        result = io::writeApplied(layered, apply);
        made = io::loadBake(folder_ / "applied");
        problems = io::verifyBake(folder_ / "applied").problems;
    }

    /// One row of a stream in one frame of what was made.
    std::array<float, kComponents> row(Stream stream, std::uint32_t frame, std::uint32_t person) const {
        std::array<float, kComponents> values{};
        const io::StreamSet streams(made.folder, made.streams, made.formats, made.frames, made.agents);
        streams[stream].readRows(frame, person, values);
        return values;
    }

    SampleCrowd crowd;
    io::Bake source, made;
    std::vector<io::LayerResult> results;
    std::optional<io::ApplyResult> result;
    std::vector<io::BakeProblem> problems;

  private:
    TemporaryFolder folder_;
};

}  // namespace throng::test
