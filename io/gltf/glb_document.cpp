// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/glb_document.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace throng::io {
namespace {

constexpr int kNoTarget = 0;

double linear(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

glm::vec3 yUp(glm::vec3 v) {
    return {v.x, v.z, -v.y};
}

void writeNumbers(OutputFile& file, std::initializer_list<std::uint32_t> numbers) {
    file.write(std::as_bytes(std::span(numbers.begin(), numbers.size())));
}

}  // namespace

GlbDocument::GlbDocument(const std::string& name, const std::array<double, 3>& root_translation)
    : model_(std::make_unique<tinygltf::Model>()) {
    model_->asset.version = "2.0";
    model_->asset.generator = "throng " THRONG_VERSION;
    tinygltf::Node root;
    root.name = name.empty() ? "throng" : name;
    if (root_translation != std::array<double, 3>{})
        root.translation.assign(root_translation.begin(), root_translation.end());
    model_->nodes.push_back(std::move(root));
    tinygltf::Scene scene;
    scene.nodes.push_back(0);
    model_->scenes.push_back(std::move(scene));
    model_->defaultScene = 0;
}

GlbDocument::~GlbDocument() = default;

int GlbDocument::addMaterial(const std::string& name, Colour colour, double roughness) {
    tinygltf::Material material;
    material.name = name;
    material.pbrMetallicRoughness.baseColorFactor = {linear(colour.red), linear(colour.green),
                                                     linear(colour.blue), 1.0};
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = roughness;
    model_->materials.push_back(std::move(material));
    return static_cast<int>(model_->materials.size()) - 1;
}

int GlbDocument::addView(std::uint64_t bytes, int target) {
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = static_cast<std::size_t>(buffer_bytes_);
    view.byteLength = static_cast<std::size_t>(bytes);
    view.target = target;
    model_->bufferViews.push_back(std::move(view));
    buffer_bytes_ += bytes;
    return static_cast<int>(model_->bufferViews.size()) - 1;
}

int GlbDocument::addStored(std::span<const std::byte> bytes, int target) {
    if (buffer_bytes_ != stored_.size()) throw std::logic_error("meshes come before tracks");
    stored_.insert(stored_.end(), bytes.begin(), bytes.end());
    return addView(bytes.size(), target);
}

GlbDocument::Geometry GlbDocument::addGeometry(const Mesh& mesh) {
    if (mesh.indices.empty()) return {};
    std::vector<glm::vec3> positions(mesh.positions.size());
    std::vector<glm::vec3> normals(mesh.normals.size());
    std::ranges::transform(mesh.positions, positions.begin(), yUp);
    std::ranges::transform(mesh.normals, normals.begin(), yUp);
    glm::vec3 minimum = positions.front();
    glm::vec3 maximum = positions.front();
    for (const glm::vec3 position : positions) {
        minimum = glm::min(minimum, position);
        maximum = glm::max(maximum, position);
    }
    const auto add = [this](int view, int component_type, int type, std::size_t count) {
        tinygltf::Accessor accessor;
        accessor.bufferView = view;
        accessor.componentType = component_type;
        accessor.type = type;
        accessor.count = count;
        model_->accessors.push_back(std::move(accessor));
        return static_cast<int>(model_->accessors.size()) - 1;
    };
    Geometry geometry;
    geometry.positions = add(addStored(std::as_bytes(std::span(positions)), TINYGLTF_TARGET_ARRAY_BUFFER),
                             TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, positions.size());
    model_->accessors.back().minValues = {minimum.x, minimum.y, minimum.z};
    model_->accessors.back().maxValues = {maximum.x, maximum.y, maximum.z};
    geometry.normals = add(addStored(std::as_bytes(std::span(normals)), TINYGLTF_TARGET_ARRAY_BUFFER),
                           TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, normals.size());
    geometry.indices =
        add(addStored(std::as_bytes(std::span(mesh.indices)), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER),
            TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, mesh.indices.size());
    return geometry;
}

int GlbDocument::addMesh(const std::string& name, const Geometry& geometry, int material) {
    tinygltf::Primitive primitive;
    primitive.attributes = {{"POSITION", geometry.positions}, {"NORMAL", geometry.normals}};
    primitive.indices = geometry.indices;
    primitive.material = material;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    tinygltf::Mesh mesh;
    mesh.name = name;
    mesh.primitives.push_back(std::move(primitive));
    model_->meshes.push_back(std::move(mesh));
    return static_cast<int>(model_->meshes.size()) - 1;
}

void GlbDocument::addMeshNode(const std::string& name, const Mesh& mesh, int material) {
    const Geometry geometry = addGeometry(mesh);
    if (geometry.indices < 0) return;
    const int node = addEmptyNode(name);
    model_->nodes[static_cast<std::size_t>(node)].mesh = addMesh(name, geometry, material);
}

int GlbDocument::addEmptyNode(const std::string& name) {
    tinygltf::Node node;
    node.name = name;
    model_->nodes.push_back(std::move(node));
    const int index = static_cast<int>(model_->nodes.size()) - 1;
    model_->nodes.front().children.push_back(index);
    return index;
}

int GlbDocument::addTimes(std::uint32_t frames, double fps) {
    std::vector<float> times;
    for (std::uint32_t frame = 0; frame < frames; ++frame)
        times.push_back(static_cast<float>(frame / fps));
    tinygltf::Accessor accessor;
    accessor.bufferView = addStored(std::as_bytes(std::span(times)), kNoTarget);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    accessor.count = frames;
    accessor.minValues = {times.front()};
    accessor.maxValues = {times.back()};
    model_->accessors.push_back(std::move(accessor));
    return static_cast<int>(model_->accessors.size()) - 1;
}

/// A view for each track: accessors' own offsets are 32 bits wide in tinygltf, views' are not.
int GlbDocument::addTrack(std::uint64_t key_bytes, std::uint32_t frames, int component_type, int type) {
    tinygltf::Accessor accessor;
    accessor.bufferView = addView(key_bytes * frames, kNoTarget);
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = frames;
    accessor.normalized = component_type != TINYGLTF_COMPONENT_TYPE_FLOAT;
    model_->accessors.push_back(std::move(accessor));
    return static_cast<int>(model_->accessors.size()) - 1;
}

void GlbDocument::addChannel(int node, const char* path, int times, int output, const char* interpolation) {
    if (model_->animations.empty()) {
        model_->animations.emplace_back();
        model_->animations.front().name = "crowd";
    }
    tinygltf::Animation& animation = model_->animations.front();
    tinygltf::AnimationSampler sampler;
    sampler.input = times;
    sampler.output = output;
    sampler.interpolation = interpolation;
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size());
    channel.target_node = node;
    channel.target_path = path;
    animation.samplers.push_back(std::move(sampler));
    animation.channels.push_back(std::move(channel));
}

int GlbDocument::addAnimatedNode(int parent, const std::string& name, int mesh, double width_scale,
                                 double height_scale, int times, std::uint32_t frames, bool has_scales) {
    tinygltf::Node node;
    node.name = name;
    node.mesh = mesh;
    node.scale = {width_scale, height_scale, width_scale};
    model_->nodes.push_back(std::move(node));
    const int index = static_cast<int>(model_->nodes.size()) - 1;
    model_->nodes[static_cast<std::size_t>(parent)].children.push_back(index);

    constexpr int kFloat = TINYGLTF_COMPONENT_TYPE_FLOAT;
    addChannel(index, "translation", times, addTrack(12, frames, kFloat, TINYGLTF_TYPE_VEC3), "LINEAR");
    addChannel(index, "rotation", times,
               addTrack(8, frames, TINYGLTF_COMPONENT_TYPE_SHORT, TINYGLTF_TYPE_VEC4), "LINEAR");
    if (has_scales)
        addChannel(index, "scale", times, addTrack(12, frames, kFloat, TINYGLTF_TYPE_VEC3), "STEP");
    return index;
}

void GlbDocument::addSeatedNode(int parent, const std::string& name, int mesh,
                                const std::array<double, 3>& place, double turn, int times,
                                std::uint32_t frames) {
    const int node = addPlacedNode(parent, name, mesh, place);
    model_->nodes[static_cast<std::size_t>(node)].rotation = {0.0, std::sin(0.5 * turn), 0.0,
                                                              std::cos(0.5 * turn)};
    addChannel(node, "scale", times, addTrack(12, frames, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3),
               "STEP");
}

int GlbDocument::addPlacedNode(int parent, const std::string& name, int mesh,
                               const std::array<double, 3>& place) {
    tinygltf::Node node;
    node.name = name;
    node.mesh = mesh;
    node.translation = {place[0], place[1], place[2]};
    model_->nodes.push_back(std::move(node));
    const int index = static_cast<int>(model_->nodes.size()) - 1;
    model_->nodes[static_cast<std::size_t>(parent)].children.push_back(index);
    return index;
}

void GlbDocument::addTurning(int node, int times, std::uint32_t frames) {
    addChannel(node, "rotation", times,
               addTrack(8, frames, TINYGLTF_COMPONENT_TYPE_SHORT, TINYGLTF_TYPE_VEC4), "LINEAR");
}

void GlbDocument::addSliding(int node, int times, std::uint32_t frames) {
    addChannel(node, "translation", times,
               addTrack(12, frames, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3), "LINEAR");
}

std::string GlbDocument::json() const {
    std::ostringstream stream;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(model_.get(), stream, false, false))
        throw std::runtime_error("the glTF document could not be built");
    nlohmann::json document = nlohmann::json::parse(stream.str());
    document["buffers"] = nlohmann::json::array({{{"byteLength", buffer_bytes_}}});
    return document.dump();
}

void GlbDocument::writeHead(OutputFile& file) {
    constexpr std::uint32_t kMagic = 0x46546c67;   // "glTF"
    constexpr std::uint32_t kJson = 0x4e4f534a;    // "JSON"
    constexpr std::uint32_t kBinary = 0x004e4942;  // "BIN\0"
    std::string text = json();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    if (buffer_bytes_ % 4 != 0) throw std::logic_error("all parts of the buffer are multiples of four bytes");
    file_size_ = 12 + 8 + text.size() + 8 + buffer_bytes_;
    if (file_size_ > 0xffffffffu)
        throw OutputError(file.path(), "would be larger than GLB files can be (4 GiB)");
    writeNumbers(file, {kMagic, 2, static_cast<std::uint32_t>(file_size_)});
    writeNumbers(file, {static_cast<std::uint32_t>(text.size()), kJson});
    file.write(text);
    writeNumbers(file, {static_cast<std::uint32_t>(buffer_bytes_), kBinary});
    file.write(stored_);
}

}  // namespace throng::io
