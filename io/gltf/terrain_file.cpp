// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/terrain_file.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <span>

#include "base/files/errors.h"
#include "io/gltf/checked_gltf.h"

namespace throng::io {
namespace {

constexpr std::size_t kMostTriangles = 8'000'000;
constexpr std::size_t kLeastPositions = 1'500'000;  // that any file may have
constexpr std::size_t kMostPieces = 200'000;        // primitives, each time that one is shown
constexpr double kFurthest = 1.0e9;                 // m

glm::dmat4 transformOf(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) {
        glm::dmat4 matrix(1.0);
        for (int i = 0; i < 16; ++i)
            matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        return matrix;
    }
    glm::dmat4 matrix(1.0);
    if (node.translation.size() == 3)
        matrix[3] = {node.translation[0], node.translation[1], node.translation[2], 1.0};
    if (node.rotation.size() == 4) {
        const glm::dquat turn(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        if (glm::length(turn) > 1.0e-9) matrix = matrix * glm::mat4_cast(glm::normalize(turn));
    }
    if (node.scale.size() == 3)
        for (int axis = 0; axis < 3; ++axis)
            matrix[axis] *= node.scale[static_cast<std::size_t>(axis)];
    return matrix;
}

template <class V>
V zUp(const V& v) {
    return {v.x, -v.z, v.y};
}

class TerrainReader {
  public:
    TerrainReader(const std::filesystem::path& path, const authoring::TerrainSettings& settings)
        : path_(path), settings_(settings), model_(loadCheckedGltf(path)) {}

    authoring::TerrainMesh read() {
        for (const int root : roots())
            visit(root);
        if (!settings_.node.empty() && !found_)
            fail(fmt::format("has no node or mesh named `{}`", settings_.node));
        if (mesh_.indices.empty()) fail("holds no triangles");
        return std::move(mesh_);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const { throw InputError(path_, what); }

    /// Of the scene that is shown, or else all nodes that are nobody's children.
    std::vector<int> roots() const {
        const tinygltf::Model& model = *model_;
        if (!model.scenes.empty())
            return model.scenes[static_cast<std::size_t>(std::max(model.defaultScene, 0))].nodes;
        std::vector<bool> is_child(model.nodes.size(), false);
        for (const tinygltf::Node& node : model.nodes)
            for (const int child : node.children)
                is_child[static_cast<std::size_t>(child)] = true;
        std::vector<int> result;
        for (std::size_t i = 0; i < is_child.size(); ++i)
            if (!is_child[i]) result.push_back(static_cast<int>(i));
        return result;
    }

    /// A stack of its own: trees may be as deep as the file likes.
    void visit(int root) {
        struct Open {
            int node;
            glm::dmat4 above;
            bool wanted;
        };
        std::vector<Open> open{{root, glm::dmat4(1.0), settings_.node.empty()}};
        while (!open.empty()) {
            const Open current = open.back();
            open.pop_back();
            const tinygltf::Node& node = model_->nodes[static_cast<std::size_t>(current.node)];
            const glm::dmat4 transform = current.above * transformOf(node);
            const tinygltf::Mesh* mesh =
                node.mesh >= 0 ? &model_->meshes[static_cast<std::size_t>(node.mesh)] : nullptr;
            const bool named = !settings_.node.empty() &&
                               (node.name == settings_.node || (mesh && mesh->name == settings_.node));
            found_ = found_ || named;
            const bool wanted = current.wanted || named;
            if (wanted && mesh)
                for (const tinygltf::Primitive& primitive : mesh->primitives) {
                    if (++pieces_ > kMostPieces) tooMuchRepeated();
                    add(primitive, transform);
                }
            // The last first, so that nodes come in the order of the file.
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
                open.push_back({*child, transform, wanted});
        }
    }

    void add(const tinygltf::Primitive& primitive, const glm::dmat4& transform) {
        const auto position = primitive.attributes.find("POSITION");
        const bool has_faces = primitive.mode == TINYGLTF_MODE_TRIANGLES ||
                               primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
                               primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
        if (!has_faces || position == primitive.attributes.end()) return;
        const std::vector<glm::dvec3> points = vectors(position->second, "positions");
        const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
        if (mesh_.positions.size() + points.size() > 3 * kMostTriangles) tooMany();
        if (mesh_.positions.size() + points.size() > mostRepeated()) tooMuchRepeated();
        for (const glm::dvec3& point : points)
            mesh_.positions.push_back(placed(point, transform));
        const std::vector<std::uint32_t> corners = cornersOf(primitive, points.size());
        if (mesh_.indices.size() + corners.size() > 3 * kMostTriangles) tooMany();
        if (mesh_.indices.size() + corners.size() > 3 * mostRepeated()) tooMuchRepeated();
        // A mirrored node turns its faces inside out, and glTF turns them back.
        const bool mirrored = glm::determinant(glm::dmat3(transform)) < 0.0;
        const std::size_t begin = mesh_.indices.size();
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
            mesh_.indices.push_back(first + corners[i]);
            mesh_.indices.push_back(first + corners[i + (mirrored ? 2 : 1)]);
            mesh_.indices.push_back(first + corners[i + (mirrored ? 1 : 2)]);
        }
        addNormals(primitive, transform, points.size(), first, begin);
    }

    /// A mesh that many nodes show, or an accessor that many primitives do, takes more memory than its file.
    std::size_t mostRepeated() const {
        std::size_t bytes = 0;
        for (const tinygltf::Buffer& buffer : model_->buffers)
            bytes += buffer.data.size();
        return kLeastPositions + bytes / 8;
    }
    [[noreturn]] void tooMuchRepeated() const {
        fail("shows the same geometry over and over: export the ground alone, as one mesh");
    }

    [[noreturn]] void tooMany() const {
        fail(fmt::format("has more than {} million triangles: export the ground alone, or a coarser one",
                         kMostTriangles / 1'000'000));
    }

    glm::dvec3 placed(const glm::dvec3& point, const glm::dmat4& transform) const {
        const glm::dvec3 there(transform * glm::dvec4(point, 1.0));
        const glm::dvec3 world = settings_.offset + settings_.scale * zUp(there);
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(world[axis]) <= kFurthest))
                fail("has a corner that is not a number, or a million kilometres away");
        return world;
    }

    /// Its own normals where it has sound ones, or those of the faces.
    void addNormals(const tinygltf::Primitive& primitive, const glm::dmat4& transform, std::size_t count,
                    std::uint32_t first, std::size_t first_index) {
        std::vector<glm::dvec3> normals(count, glm::dvec3(0.0));
        const auto given = primitive.attributes.find("NORMAL");
        const glm::dmat3 linear(transform);
        if (given != primitive.attributes.end() && std::abs(glm::determinant(linear)) > 1.0e-12) {
            normals = vectors(given->second, "normals");
            const glm::dmat3 matrix = glm::transpose(glm::inverse(linear));
            for (glm::dvec3& normal : normals)
                normal = zUp(matrix * normal);
            normals.resize(count, glm::dvec3(0.0));
        } else {
            for (std::size_t i = first_index; i + 2 < mesh_.indices.size(); i += 3) {
                const std::uint32_t* corner = &mesh_.indices[i];
                const glm::dvec3 a = mesh_.positions[corner[0]];
                const glm::dvec3 face =
                    glm::cross(mesh_.positions[corner[1]] - a, mesh_.positions[corner[2]] - a);
                for (int k = 0; k < 3; ++k)
                    normals[corner[k] - first] += face;
            }
        }
        for (const glm::dvec3& normal : normals) {
            const double size = glm::length(normal);
            const bool sound = std::isfinite(size) && size > 1.0e-12;
            mesh_.normals.push_back(sound ? glm::vec3(normal / size) : glm::vec3(0.0f, 0.0f, 1.0f));
        }
    }

    /// Where accessor's items lie; loadCheckedGltf() has made sure that they do.
    struct Items {
        const unsigned char* first;
        std::size_t stride;
        std::size_t count;
    };
    Items itemsOf(const tinygltf::Accessor& accessor) const {
        const tinygltf::BufferView& view = model_->bufferViews[static_cast<std::size_t>(accessor.bufferView)];
        const tinygltf::Buffer& buffer = model_->buffers[static_cast<std::size_t>(view.buffer)];
        const int size =
            tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)) *
            tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
        return {buffer.data.data() + view.byteOffset + accessor.byteOffset,
                view.byteStride ? view.byteStride : static_cast<std::size_t>(size), accessor.count};
    }

    std::vector<glm::dvec3> vectors(int index, const char* what) const {
        const tinygltf::Accessor& accessor = model_->accessors[static_cast<std::size_t>(index)];
        if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT || accessor.type != TINYGLTF_TYPE_VEC3)
            fail(fmt::format("has {} that are not three floats each: export it without quantisation", what));
        const Items items = itemsOf(accessor);
        std::vector<glm::dvec3> result;
        result.reserve(items.count);
        for (std::size_t i = 0; i < items.count; ++i) {
            float values[3];
            std::memcpy(values, items.first + i * items.stride, sizeof values);
            result.emplace_back(values[0], values[1], values[2]);
        }
        return result;
    }

    std::vector<std::uint32_t> indicesOf(const tinygltf::Primitive& primitive, std::size_t count) const {
        std::vector<std::uint32_t> result;
        if (primitive.indices < 0) {
            result.resize(count);
            for (std::size_t i = 0; i < count; ++i)
                result[i] = static_cast<std::uint32_t>(i);
            return result;
        }
        const tinygltf::Accessor& accessor = model_->accessors[static_cast<std::size_t>(primitive.indices)];
        const Items items = itemsOf(accessor);
        if (accessor.type != TINYGLTF_TYPE_SCALAR) fail("has indices that are not single numbers");
        result.reserve(items.count);
        for (std::size_t i = 0; i < items.count; ++i) {
            const unsigned char* at = items.first + i * items.stride;
            std::uint32_t value = 0;
            if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE)
                value = *at;
            else if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
                value = static_cast<std::uint32_t>(at[0] | at[1] << 8);
            else if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
                std::memcpy(&value, at, sizeof value);
            else
                fail("has indices that are not whole numbers");
            if (value >= count) fail(fmt::format("has an index {} where there are {} corners", value, count));
            result.push_back(value);
        }
        return result;
    }

    /// Strips and fans as separate triangles.
    std::vector<std::uint32_t> cornersOf(const tinygltf::Primitive& primitive, std::size_t count) const {
        std::vector<std::uint32_t> indices = indicesOf(primitive, count);
        if (primitive.mode == TINYGLTF_MODE_TRIANGLES) {
            indices.resize(indices.size() / 3 * 3);
            return indices;
        }
        if (indices.size() > kMostTriangles) tooMany();
        std::vector<std::uint32_t> corners;
        for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
            const bool strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
            const std::size_t odd = strip ? i % 2 : 0;
            corners.push_back(strip ? indices[i] : indices[0]);
            corners.push_back(indices[i + 1 + odd]);
            corners.push_back(indices[i + 2 - odd]);
        }
        return corners;
    }

    const std::filesystem::path& path_;
    const authoring::TerrainSettings& settings_;
    std::unique_ptr<tinygltf::Model> model_;
    authoring::TerrainMesh mesh_;
    bool found_ = false;
    std::size_t pieces_ = 0;
};

}  // namespace

authoring::TerrainMesh readTerrain(const std::filesystem::path& path,
                                   const authoring::TerrainSettings& settings) {
    return TerrainReader(path, settings).read();
}

}  // namespace throng::io
