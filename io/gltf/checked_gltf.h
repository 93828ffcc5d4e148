// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

namespace tinygltf {
class Model;
}

namespace throng::io {

/// What a glTF file may hold at most.
struct GltfLimits {
    std::uint64_t file_bytes = std::uint64_t{512} << 20;    ///< of the file itself
    std::uint64_t buffer_bytes = std::uint64_t{512} << 20;  ///< of all buffers beside it, each
    std::size_t nodes = 100'000;
    std::size_t accessors = 200'000;
    std::size_t primitives = 20'000;    ///< of all meshes
    std::size_t elements = 50'000'000;  ///< of one accessor
};

/// The geometry of a .gltf or .glb file from anybody: nodes, meshes, accessors, buffer views and buffers, and
/// nothing else (no images, no animations, no extras). Every index among them leads somewhere, nodes form
/// trees, and every accessor lies inside its buffer. Files beside it are read from its own folder only.
/// @throws InputError, which says what is wrong
std::unique_ptr<tinygltf::Model> loadCheckedGltf(const std::filesystem::path& path,
                                                 const GltfLimits& limits = {});

}  // namespace throng::io
