// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/files/hash.h"
#include "io/agent_table.h"
#include "io/gltf/crowd_glb.h"
#include "recording/bake_description.h"

namespace throng::io {

/// How long the bake took.
struct BakeTiming {
    double wall_seconds = 0.0;
    std::uint64_t steps = 0;
};

/// The diagram images of a bake.
struct DiagramSummary {
    std::uint32_t count = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    double pixels_per_metre = 0.0;
    glm::dvec2 minimum{0.0};  ///< m, relative to the output origin
};

/// What is known once the last frame is written.
struct BakeOutcome {
    bool complete = false;
    std::uint32_t frames = 0;
    AccountTotals account;
    BakeTiming timing;
    std::uint32_t gaits = 0;  ///< bit by gait: which of the strides somebody walks with
    std::optional<GltfSummary> gltf;
    std::optional<DiagramSummary> diagrams;
    struct File {
        std::string path;  ///< relative to the bake, with forward slashes
        FileHash hash;
    };
    std::vector<File> files;
};

/// The content of bake.json.
nlohmann::ordered_json bakeManifest(const recording::BakeDescription& description,
                                    const BakeOutcome& outcome);

/// Its member `streams`.
nlohmann::ordered_json streamsToJson(const StreamChoice& streams, const StreamFormats& formats);

/// The text of bake.json, with its own `checksum` as the last member: XXH3 of the text that has zeros in the
/// place of the checksum's digits.
std::string manifestText(nlohmann::ordered_json manifest);

/// Whether the text of a bake.json has a checksum of itself, and whether that fits.
enum class OwnChecksum { absent, fits, wrong };
OwnChecksum checkManifest(std::string text, const nlohmann::ordered_json& manifest);

}  // namespace throng::io
