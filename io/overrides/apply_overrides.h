// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>

#include "io/overrides/layered_crowd.h"
#include "io/overrides/overlaps.h"

namespace throng::io {

/// The changes to one row.
struct RowChange {
    std::uint32_t row = 0;
    authoring::PersonChange change;
};

struct ApplyOptions {
    std::filesystem::path output;  ///< the bake to make
    bool force = false;            ///< replace an existing bake
    bool watch_overlaps = false;   ///< tell who is in whom for being moved
    bool gltf = false;             ///< write crowd.glb
    std::uint32_t gltf_agents = 2000;
    std::string identity;              ///< what is applied, for the hash of the bake's inputs
    nlohmann::ordered_json applied{};  ///< for the manifest: what was applied to whom
    /// Asked after each frame; false stops and leaves nothing behind.
    std::function<bool(std::uint32_t frames_done)> go_on = [](std::uint32_t) { return true; };
};

struct ApplyResult {
    std::filesystem::path path{};
    std::uint32_t held =
        0;  ///< people whose new times reach beyond the bake while they are there: they stand
    std::vector<Overlap> overlaps{};
    std::vector<InWall> in_walls{};
};

/// Does to some rows what their overrides say.
void changeRows(LayeredCrowd& crowd, std::span<const RowChange> changes);

/// Writes a bake of a crowd that was changed: streams, agents.csv, crowd.glb and manifest anew, everything
/// else as it is in the source; diagrams are left out, as they show people where they were. The new bake
/// appears when it is complete. @returns nothing when `go_on` said no. Throws InputError and OutputError.
std::optional<ApplyResult> writeApplied(LayeredCrowd& crowd, const ApplyOptions& options);

}  // namespace throng::io
