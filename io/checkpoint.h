// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace throng::io {

/// From where a bake can go on.
struct Checkpoint {
    std::string identity;  ///< of what is being baked, so that nothing else goes on from here
    std::uint32_t frames = 0;
    std::uint32_t steps = 0;
    using Section = std::pair<std::string, std::vector<std::byte>>;
    std::vector<Section> sections;

    void add(const std::string& name, std::span<const std::byte> bytes) {
        sections.emplace_back(name, std::vector(bytes.begin(), bytes.end()));
    }
    /// Null where there is none of this name.
    const std::vector<std::byte>* find(const std::string& name) const;
};

/// Writes `checkpoint.a` or `checkpoint.b`, whichever is older or torn: the other one stays whole until the
/// new one is on the disk. Throws OutputError.
void saveCheckpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint);

/// The latest whole checkpoint of a folder; torn ones are known by their checksum and passed over.
std::optional<Checkpoint> loadCheckpoint(const std::filesystem::path& folder);

/// Whether there are checkpoints in a folder of which none is whole.
bool hasOnlyTornCheckpoints(const std::filesystem::path& folder);

/// Whether a file in the folder of a bake belongs to its checkpoints.
bool isCheckpoint(const std::filesystem::path& path);

}  // namespace throng::io
