// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/files/output_file.h"
#include "base/palette.h"
#include "io/gltf/meshes.h"

namespace tinygltf {
class Model;
}

namespace throng::io {

/// A binary glTF file whose animation data is streamed after the head instead of being held in memory.
///
/// tinygltf builds the JSON part. It would also hold and write the whole buffer, and says nothing when that
/// fails, so the bytes are written here, checked.
class GlbDocument {
  public:
    struct Geometry {
        int positions = -1;
        int normals = -1;
        int indices = -1;
    };

    /// `root_translation` (Y up) goes to the one root node, below which everything lies.
    GlbDocument(const std::string& name, const std::array<double, 3>& root_translation);
    ~GlbDocument();

    int addMaterial(const std::string& name, Colour colour, double roughness);
    /// Geometry is given Z up; a mesh without triangles adds nothing (all indices are -1 then).
    Geometry addGeometry(const Mesh& mesh);
    int addMesh(const std::string& name, const Geometry& geometry, int material);
    /// A node with a mesh of its own; nothing for a mesh without triangles.
    void addMeshNode(const std::string& name, const Mesh& mesh, int material);
    /// Returns the node.
    int addEmptyNode(const std::string& name);
    /// The accessor that all tracks share: frame i at i / fps seconds.
    int addTimes(std::uint32_t frames, double fps);
    /// Announces tracks of translations (3 floats), rotations (4 normalised shorts) and, if asked for,
    /// stepped scales (3 floats), to be written in this order after the head. All meshes come before the
    /// first of these.
    /// Returns the node.
    int addAnimatedNode(int parent, const std::string& name, int mesh, double width_scale,
                        double height_scale, int times, std::uint32_t frames, bool has_scales);

    /// A person's node that stays where it is, turned about the vertical (rad). Announces a track of scales.
    void addSeatedNode(int parent, const std::string& name, int mesh, const std::array<double, 3>& place,
                       double turn, int times, std::uint32_t frames);
    /// A node that goes along with its parent. Returns it.
    int addPlacedNode(int parent, const std::string& name, int mesh, const std::array<double, 3>& place);
    /// Announces a track of a node's rotations, as those of addAnimatedNode().
    void addTurning(int node, int times, std::uint32_t frames);
    /// Likewise of its translations.
    void addSliding(int node, int times, std::uint32_t frames);

    /// Writes all up to the first track. Throws OutputError.
    void writeHead(OutputFile& file);
    /// Of the whole file once all tracks are written; known after writeHead().
    std::uint64_t fileSize() const { return file_size_; }

  private:
    int addView(std::uint64_t bytes, int target);
    int addStored(std::span<const std::byte> bytes, int target);
    int addTrack(std::uint64_t key_bytes, std::uint32_t frames, int component_type, int type);
    void addChannel(int node, const char* path, int times, int output, const char* interpolation);
    std::string json() const;

    std::unique_ptr<tinygltf::Model> model_;
    std::vector<std::byte> stored_;   ///< the buffer's beginning: meshes and times
    std::uint64_t buffer_bytes_ = 0;  ///< of the whole buffer, announced tracks included
    std::uint64_t file_size_ = 0;
};

}  // namespace throng::io
