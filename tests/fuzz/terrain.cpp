// SPDX-License-Identifier: Apache-2.0
// Terrain in glTF files (.glb, or .gltf with its buffers inside), and the scene that stands on it.
#include <cstring>
#include <random>

#include "authoring/layout/layout_reader.h"
#include "io/gltf/terrain_file.h"
#include "support/custom_json.h"
#include "support/small_scene.h"

using namespace throng;

namespace {

constexpr const char* kLayout = R"({"throng": 1, "terrain": {"file": "ground.glb"},
    "areas": [{"id": "low", "polygon": [[0, 0], [3, 0], [3, 3], [0, 3]]},
              {"id": "high", "polygon": [[5, 5], [8, 5], [8, 8], [5, 8]]}],
    "walls": [{"points": [[4, 0], [4, 4]]}],
    "flows": [{"id": "up", "from": "low", "to": "high", "count": 3}]})";
constexpr std::size_t kHead = 12, kChunkHead = 8;  // bytes of a .glb and of each of its chunks

std::uint32_t wordAt(std::string_view bytes, std::size_t at) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

void append(std::string& bytes, std::uint32_t word) {
    bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
}

/// A .glb from its two chunks, whose lengths are as they should be.
std::string glbOf(std::string json, std::string binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4);
    std::string bytes = "glTF";
    append(bytes, 2);
    append(bytes, static_cast<std::uint32_t>(kHead + 2 * kChunkHead + json.size() + binary.size()));
    append(bytes, static_cast<std::uint32_t>(json.size()));
    bytes += "JSON" + json;
    append(bytes, static_cast<std::uint32_t>(binary.size()));
    return bytes + std::string("BIN\0", 4) + binary;
}

const fuzz::JsonMutator& mutator() {
    static const fuzz::JsonMutator made{
        R"({"words": ["asset", "version", "scene", "scenes", "nodes", "children", "mesh",
        "meshes", "primitives", "attributes", "POSITION", "NORMAL", "indices", "mode", "accessors",
        "bufferView",
        "byteOffset", "componentType", "count", "type", "SCALAR", "VEC2", "VEC3", "VEC4", "MAT4", "min",
        "max", "sparse",
        "bufferViews", "buffer", "byteLength", "byteStride", "target", "buffers", "uri", "name",
        "matrix", "rotation",
        "scale", "translation", "extensions", "extensionsRequired", "KHR_draco_mesh_compression", "extras",
        "data:application/octet-stream;base64,AAAA", "ground.glb", "../ground.glb"],
        "numbers": [1, 2, 3, 4, 5, 6, 5120, 5121, 5122, 5123, 5124, 5125, 5126, 5130, 252, 255]})"};
    return made;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
    const std::string_view input = fuzz::textOf(data, size);
    std::mt19937 random(seed);
    if (input.starts_with("{")) return fuzz::giveTo(data, most, mutator().mutate(input, most, seed));
    constexpr std::size_t kLeast = kHead + kChunkHead;
    if (size < kLeast || wordAt(input, kHead) > size - kLeast || random() % 20 == 0)
        return fuzz::giveTo(data, most, fuzz::mutatedBytes(input, most));
    std::string json(input.substr(kLeast, wordAt(input, kHead)));
    std::string binary(input.substr(std::min(size, kLeast + json.size() + kChunkHead)));
    const std::size_t room = most > 2 * kLeast ? most - 2 * kLeast : 0;
    if (random() % 3 != 0 && room > binary.size())
        json = mutator().mutate(json, room - binary.size(), static_cast<unsigned>(random()));
    else if (room > json.size())
        binary = fuzz::mutatedBytes(binary, room - json.size());
    return fuzz::giveTo(data, most, glbOf(json, binary));
}

void fuzz::readOne(std::string_view input) {
    const std::filesystem::path file = put("ground.glb", input);
    authoring::Diagnostics diagnostics;
    static const auto layout = authoring::readLayout(kLayout, {}, diagnostics);
    if (!layout) finding("the terrain's layout is wrong");
    const authoring::TerrainMesh mesh = io::readTerrain(file, *layout->terrain);
    for (const std::uint32_t index : mesh.indices)
        if (index >= mesh.positions.size()) finding("an index beyond the positions");
    buildIfSmall(*layout, diagnostics, &mesh);
    tell(diagnostics, kLayout);
}
