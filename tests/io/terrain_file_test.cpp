// SPDX-License-Identifier: Apache-2.0
// Terrains from anybody: sound ones give known triangles, all others one clear error, and never a crash or a
// hang.
#include "io/gltf/terrain_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "base/files/errors.h"

namespace throng::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A square of 2 x 2 units, its corner at the file's origin, that rises by 1 along x.
class TerrainFileTest : public ::testing::Test {
  protected:
    TerrainFileTest() {
        folder_ = fs::temp_directory_path() / ("throng-terrain-" + std::to_string(::getpid()));
        fs::create_directories(folder_ / "inside");
        const float points[] = {0, 0, 0, 2, 1, 0, 2, 1, -2, 0, 0, -2};  // y up
        const std::uint32_t corners[] = {0, 1, 2, 0, 2, 3};
        binary_.assign(reinterpret_cast<const char*>(points), sizeof points);
        binary_.append(reinterpret_cast<const char*>(corners), sizeof corners);
        document_ = Json::parse(R"({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": [{"name": "hill", "mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                          {"bufferView": 1, "componentType": 5125, "count": 6, "type": "SCALAR"}],
            "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48},
                            {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
            "buffers": [{"byteLength": 72}]})");
    }
    ~TerrainFileTest() override { fs::remove_all(folder_); }

    static void append(std::string& bytes, std::uint32_t word) {
        bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
    }
    std::string glb() const { return glb(document_.dump()); }
    std::string glb(std::string text) const {
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string bytes = "glTF";
        append(bytes, 2);
        append(bytes, static_cast<std::uint32_t>(28 + text.size() + binary_.size()));
        append(bytes, static_cast<std::uint32_t>(text.size()));
        bytes += "JSON" + text;
        append(bytes, static_cast<std::uint32_t>(binary_.size()));
        return bytes + std::string("BIN\0", 4) + binary_;
    }
    fs::path write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return folder_ / name;
    }
    authoring::TerrainMesh read(const fs::path& path) const { return io::readTerrain(path, settings_); }
    /// What the error says; a failure where there is none.
    std::string refusal(const fs::path& path) const {
        try {
            read(path);
        } catch (const InputError& error) {
            return error.what();
        }
        ADD_FAILURE() << path << " was read";
        return {};
    }
    std::string refusal(const std::function<void(Json&)>& change) const {
        Json changed = document_;
        change(changed);
        return refusal(write("changed.glb", glb(changed.dump())));
    }

    fs::path folder_;
    std::string binary_;
    Json document_;
    authoring::TerrainSettings settings_;
};

#define EXPECT_SAYS(text, words) EXPECT_NE((text).find(words), std::string::npos) << (text)

TEST_F(TerrainFileTest, LiesAsTheLayoutPlacesIt) {
    settings_.offset = {500000.25, 4200000.5, 100.0};
    settings_.scale = 3.0;
    document_["nodes"][0]["translation"] = {1.0, 2.0, -4.0};
    const authoring::TerrainMesh mesh = read(write("hill.glb", glb()));
    ASSERT_EQ(mesh.positions.size(), 4u);
    ASSERT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    const glm::dvec3 corner = mesh.positions[2];  // (2, 1, -2) + (1, 2, -4) is (3, 3, -6): z up (3, 6, 3)
    EXPECT_DOUBLE_EQ(corner.x, 500000.25 + 9.0);
    EXPECT_DOUBLE_EQ(corner.y, 4200000.5 + 18.0);
    EXPECT_DOUBLE_EQ(corner.z, 100.0 + 9.0);
    EXPECT_NEAR(mesh.normals[0].x, -1.0 / std::sqrt(5.0), 1e-6);
    EXPECT_NEAR(mesh.normals[0].z, 2.0 / std::sqrt(5.0), 1e-6);
}

TEST_F(TerrainFileTest, BuffersMayLieBesideOrInTheFile) {
    write("inside/points.bin", binary_);
    document_["buffers"][0]["uri"] = "inside/points.bin";
    EXPECT_EQ(read(write("beside.gltf", document_.dump())).indices.size(), 6u);
    std::string base64;
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < binary_.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return static_cast<unsigned>(static_cast<unsigned char>(binary_[k]));
        };
        const unsigned word = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
        for (int shift = 18; shift >= 0; shift -= 6)
            base64 += digits[word >> shift & 63];
    }
    document_["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64;
    EXPECT_EQ(read(write("inline.gltf", document_.dump())).positions[2].z, 1.0);
}

TEST_F(TerrainFileTest, MirroredNodesStillLookUpAndNamesChoose) {
    document_["nodes"] =
        Json::parse(R"([{"children": [1, 2]}, {"name": "hill", "mesh": 0, "scale": [-1, 1, 1]},
                                         {"name": "tree", "mesh": 0, "translation": [0, 9, 0]}])");
    settings_.node = "hill";
    const authoring::TerrainMesh mesh = read(write("two.glb", glb()));
    ASSERT_EQ(mesh.indices.size(), 6u);
    const glm::dvec3 a = mesh.positions[mesh.indices[0]], b = mesh.positions[mesh.indices[1]],
                     c = mesh.positions[mesh.indices[2]];
    EXPECT_GT((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), 0.0);
    EXPECT_GT(mesh.normals[0].z, 0.0f);
    settings_.node = "mountain";
    EXPECT_SAYS(refusal(folder_ / "two.glb"), "named `mountain`");
}

TEST_F(TerrainFileTest, StripsAreReadAndPointsPassedOver) {
    const std::uint32_t strip[] = {0, 1, 3, 2};
    std::memcpy(binary_.data() + 48, strip, sizeof strip);
    document_["accessors"][1]["count"] = 4;
    document_["meshes"][0]["primitives"][0]["mode"] = 5;
    EXPECT_EQ(read(write("strip.glb", glb())).indices, (std::vector<std::uint32_t>{0, 1, 3, 1, 2, 3}));
    document_["meshes"][0]["primitives"][0]["mode"] = 0;
    EXPECT_SAYS(refusal(write("points.glb", glb())), "no triangles");
}

TEST_F(TerrainFileTest, IndicesThatLeadNowhereAreRefused) {
    const std::uint32_t far = 4;
    std::memcpy(binary_.data() + 52, &far, sizeof far);
    EXPECT_SAYS(refusal(write("corner.glb", glb())), "index 4 where there are 4");
    EXPECT_SAYS(refusal([](Json& d) { d["nodes"][0]["mesh"] = 7; }), "`mesh` is 7, there are 1");
    EXPECT_SAYS(refusal([](Json& d) { d["nodes"][0]["mesh"] = -1; }), "`mesh` is -1");
    EXPECT_SAYS(refusal([](Json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 9; }),
                "there are 2");
    EXPECT_SAYS(refusal([](Json& d) { d["meshes"][0]["primitives"][0]["indices"] = 2; }), "there are 2");
    EXPECT_SAYS(refusal([](Json& d) { d["accessors"][0]["bufferView"] = 5; }), "there are 2");
    EXPECT_SAYS(refusal([](Json& d) { d["accessors"][0].erase("bufferView"); }), "no buffer view");
    EXPECT_SAYS(refusal([](Json& d) { d["bufferViews"][0]["buffer"] = 1; }), "there are 1");
    EXPECT_SAYS(refusal([](Json& d) { d["scenes"][0]["nodes"][0] = 3; }), "there are 1");
    EXPECT_SAYS(refusal([](Json& d) { d["scene"] = 3; }), "there are 1");
}

TEST_F(TerrainFileTest, NothingIsReadBeyondABuffer) {
    EXPECT_SAYS(refusal([](Json& d) { d["accessors"][0]["count"] = 5; }),
                "reaches 60 bytes into a buffer view of 48");
    EXPECT_SAYS(refusal([](Json& d) { d["accessors"][0]["byteOffset"] = 4; }), "reaches 52");
    EXPECT_SAYS(refusal([](Json& d) {
                    d["accessors"][0]["count"] = 0;
                    d["accessors"][0]["byteOffset"] = 400000;
                }),
                "reaches");
    EXPECT_SAYS(refusal([](Json& d) { d["bufferViews"][0]["byteLength"] = 480; }), "reaches 480");
    EXPECT_SAYS(refusal([](Json& d) { d["bufferViews"][0]["byteStride"] = 8; }), "overlap");
    EXPECT_SAYS(refusal([](Json& d) { d["buffers"][0]["byteLength"] = 7200; }), "byteLength");
    EXPECT_SAYS(refusal([](Json& d) { d["buffers"][0]["byteLength"] = 18446744073709551615u; }),
                "expected a whole number");
    EXPECT_SAYS(refusal([](Json& d) { d["accessors"][0]["count"] = 1e30; }), "expected a whole number");
    EXPECT_SAYS(refusal([](Json& d) { d["accessors"][0]["componentType"] = 5130; }),
                "reaches 96");  // doubles
    EXPECT_SAYS(refusal([](Json& d) { d["nodes"][0]["scale"] = {1e12, 1e12, 1e12}; }), "million kilometres");
    EXPECT_SAYS(refusal([](Json& d) { d["nodes"][0]["matrix"] = {1, 2}; }), "not 16 numbers");
}

TEST_F(TerrainFileTest, NodesThatBiteTheirTailAreRefused) {
    EXPECT_SAYS(refusal([](Json& d) {
                    d["nodes"] = Json::parse(R"([{"children": [1]}, {"children": [0], "mesh": 0}])");
                }),
                "cycle");
    EXPECT_SAYS(refusal([](Json& d) { d["nodes"][0]["children"] = {0}; }), "cycle");
    EXPECT_SAYS(refusal([](Json& d) {
                    d["nodes"] = Json::parse(R"([{"children": [2]}, {"children": [2]}, {"mesh": 0}])");
                }),
                "more than one parent");
}

TEST_F(TerrainFileTest, ALongChainOfNodesIsNoTrouble) {
    Json nodes = Json::array();
    for (int i = 0; i < 20000; ++i)
        nodes.push_back({{"children", {i + 1}}, {"translation", {0.0, 0.001, 0.0}}});
    nodes.push_back({{"mesh", 0}});
    document_["nodes"] = nodes;
    EXPECT_NEAR(read(write("chain.glb", glb())).positions[0].z, 20.0, 1e-6);
}

TEST_F(TerrainFileTest, DeepNestingIsRefusedBeforeItIsParsed) {
    const std::string deep(1'000'000, '[');
    EXPECT_SAYS(refusal(write("deep.gltf", "{\"extras\":" + deep)), "nested");
    EXPECT_SAYS(refusal(write("deep.glb", glb("{\"extras\":" + deep))), "nested");
    EXPECT_SAYS(refusal(write("objects.gltf",
                              [] {
                                  std::string text;
                                  for (int i = 0; i < 200000; ++i)
                                      text += "{\"a\":";
                                  return text;
                              }())),
                "nested");
}

TEST_F(TerrainFileTest, OnlyFilesOfItsOwnFolderAreOpened) {
    const fs::path outside = folder_.parent_path() / (folder_.filename().string() + ".bin");
    std::ofstream(outside, std::ios::binary) << binary_;
    fs::create_symlink(outside, folder_ / "link.bin");
    ::mkfifo((folder_ / "pipe.bin").c_str(), 0600);
    const std::string up = "../" + outside.filename().string();
    std::string escaped = "%2e%2e/" + outside.filename().string();
    for (const std::string& uri :
         {up, escaped, outside.string(), "inside/../" + up, std::string("link.bin"), std::string("pipe.bin"),
          std::string("inside"), std::string("absent.bin"), std::string(""), std::string("/dev/zero"),
          std::string("http://example.org/points.bin")}) {
        document_["buffers"][0]["uri"] = uri;
        EXPECT_FALSE(refusal(write("escape.gltf", document_.dump())).empty()) << uri;
    }
    document_["buffers"][0]["uri"] = up;
    EXPECT_SAYS(refusal(write("escape.gltf", document_.dump())), "leads out");
    document_["buffers"][0]["uri"] = "pipe.bin";
    EXPECT_SAYS(refusal(write("escape.gltf", document_.dump())), "not a regular file");
    EXPECT_SAYS(refusal(folder_ / "pipe.bin"), "not a regular file");
    fs::remove(outside);
}

TEST_F(TerrainFileTest, WhatItCannotReadItNames) {
    EXPECT_SAYS(refusal([](Json& d) { d["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }),
                "KHR_draco_mesh_compression");
    EXPECT_SAYS(refusal([](Json& d) { d["accessors"][0]["componentType"] = 5123; }), "three floats");
    EXPECT_SAYS(refusal(folder_ / "absent.glb"), "cannot open");
    EXPECT_SAYS(refusal(write("text.glb", "hello")), "not glTF");
    EXPECT_SAYS(refusal(write("empty.glb", "")), "not glTF");
}

TEST_F(TerrainFileTest, ImagesAreNotLookedAt) {
    document_["images"] =
        Json::parse(R"([{"bufferView": 1, "mimeType": "image/png"}, {"uri": "../secret.png"}])");
    document_["textures"] = Json::parse(R"([{"source": 77}])");
    EXPECT_EQ(read(write("images.glb", glb())).indices.size(), 6u);
}

TEST_F(TerrainFileTest, TruncatedAndFlippedFilesNeverDoHarm) {
    const std::string whole = glb();
    std::size_t refused = 0;
    for (std::size_t size = 0; size < whole.size(); size += 7) {
        EXPECT_THROW(read(write("cut.glb", whole.substr(0, size))), InputError) << size;
        ++refused;
    }
    std::mt19937 random(5);
    for (int i = 0; i < 600; ++i) {
        std::string changed = whole;
        for (int flips = 0; flips < 1 + i % 4; ++flips)
            changed[random() % changed.size()] ^= static_cast<char>(1u << random() % 8);
        try {
            const authoring::TerrainMesh mesh = read(write("flipped.glb", changed));
            for (const std::uint32_t index : mesh.indices)
                ASSERT_LT(index, mesh.positions.size());
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 250u);
}

}  // namespace
}  // namespace throng::test
