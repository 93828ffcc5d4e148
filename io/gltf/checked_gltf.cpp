// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/checked_gltf.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "base/files/beneath.h"
#include "base/files/input_file.h"
#include "base/json_shape.h"

namespace throng::io {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

constexpr std::uint32_t kGlb = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

std::uint32_t wordAt(std::string_view bytes, std::size_t at) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

void appendWord(std::string& bytes, std::uint32_t word) {
    bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
}

/// The two parts of a file.
struct Parts {
    std::string_view json;
    std::string_view binary;
    bool is_glb = false;
};

class Loader {
  public:
    Loader(const fs::path& path, const GltfLimits& limits) : path_(path), limits_(limits) {}

    std::unique_ptr<tinygltf::Model> load() {
        const std::string bytes = readFile(path_, limits_.file_bytes);
        const Parts parts = split(bytes);
        if (const char* problem = tooMuchIn(parts.json)) fail(std::string("its JSON ") + problem);
        Json document = Json::parse(parts.json, nullptr, false);
        if (document.is_discarded() || !document.is_object()) fail("is not glTF: its JSON cannot be parsed");
        const Json geometry = onlyGeometry(document);
        auto model = std::make_unique<tinygltf::Model>();
        parse(geometry.dump(), parts, *model);
        checkAccessors(*model);
        return model;
    }

  private:
    [[noreturn]] void fail(const std::string& what) const { throw InputError(path_, what); }

    Parts split(std::string_view bytes) const {
        if (bytes.size() < 4 || wordAt(bytes, 0) != kGlb) return {bytes, {}, false};
        if (bytes.size() < 20) fail("is a truncated GLB file");
        if (wordAt(bytes, 4) != 2)
            fail(fmt::format("is a GLB file of version {}; 2 is expected", wordAt(bytes, 4)));
        if (wordAt(bytes, 8) > bytes.size())
            fail(fmt::format("is truncated: {} of {} bytes", bytes.size(), wordAt(bytes, 8)));
        const std::string_view whole = bytes.substr(0, wordAt(bytes, 8));
        Parts parts;
        parts.is_glb = true;
        std::size_t at = 12;
        for (int chunk = 0; at + 8 <= whole.size() && chunk < 2; ++chunk) {
            const std::size_t size = wordAt(whole, at);
            const std::uint32_t kind = wordAt(whole, at + 4);
            if (size > whole.size() - at - 8) fail(fmt::format("has a chunk that is longer than the file"));
            if (kind == kJsonChunk && chunk == 0) parts.json = whole.substr(at + 8, size);
            if (kind == kBinaryChunk && chunk == 1) parts.binary = whole.substr(at + 8, size);
            at += 8 + size;
        }
        if (parts.json.empty()) fail("is a GLB file without JSON");
        return parts;
    }

    const Json& listOf(const Json& document, const char* key, std::size_t most) const {
        static const Json none = Json::array();
        const auto found = document.find(key);
        if (found == document.end()) return none;
        if (!found->is_array()) fail(fmt::format("`{}` is no array", key));
        if (found->size() > most)
            fail(fmt::format("has {} {}, more than the {} that can be", found->size(), key, most));
        for (const Json& item : *found)
            if (!item.is_object()) fail(fmt::format("`{}` holds something that is no object", key));
        return *found;
    }

    /// An index into a list of `count`, or nothing where the member is absent.
    std::optional<std::size_t> indexIn(const Json& item, const char* key, std::size_t count,
                                       const std::string& whose) const {
        const auto found = item.find(key);
        if (found == item.end()) return std::nullopt;
        return checkedIndex(*found, key, count, whose);
    }
    std::size_t checkedIndex(const Json& value, const char* key, std::size_t count,
                             const std::string& whose) const {
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count)
            fail(fmt::format("{}: `{}` is {}, there are {}", whose, key, shortly(value), count));
        return static_cast<std::size_t>(value.get<std::uint64_t>());
    }
    static std::string shortly(const Json& value) {
        std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
        return text.size() > 40 ? text.substr(0, 40) + "..." : text;
    }
    /// A whole number, `otherwise` where it is absent.
    std::uint64_t wholeOf(const Json& item, const char* key, std::uint64_t otherwise, std::uint64_t most,
                          const std::string& whose) const {
        const auto found = item.find(key);
        if (found == item.end()) return otherwise;
        if (!found->is_number_unsigned() || found->get<std::uint64_t>() > most)
            fail(fmt::format("{}: `{}` is {}, expected a whole number up to {}", whose, key, shortly(*found),
                             most));
        return found->get<std::uint64_t>();
    }

    Json onlyGeometry(const Json& document) const {
        checkExtensions(document);
        Json result = {{"asset", {{"version", "2.0"}}}};
        result["buffers"] = buffersOf(document);
        result["bufferViews"] = viewsOf(document, result["buffers"].size());
        result["accessors"] = accessorsOf(document, result["bufferViews"].size());
        result["meshes"] = meshesOf(document, result["accessors"]);
        result["nodes"] = nodesOf(document, result["meshes"].size());
        result["scenes"] = scenesOf(document, result["nodes"].size());
        if (const auto scene = indexIn(document, "scene", result["scenes"].size(), "the file"))
            result["scene"] = *scene;
        return result;
    }

    /// Those that change how geometry is stored cannot be passed over.
    void checkExtensions(const Json& document) const {
        const auto required = document.find("extensionsRequired");
        if (required == document.end()) return;
        if (!required->is_array()) fail("`extensionsRequired` is no array");
        for (const Json& entry : *required) {
            const std::string name = entry.is_string() ? entry.get<std::string>() : shortly(entry);
            if (!name.starts_with("KHR_materials_") && !name.starts_with("KHR_texture_") &&
                name != "KHR_lights_punctual" && name != "EXT_texture_webp")
                fail(fmt::format("needs the extension {}, which is not read: export it without",
                                 name.substr(0, 60)));
        }
    }

    Json buffersOf(const Json& document) const {
        Json buffers = Json::array();
        for (const Json& item : listOf(document, "buffers", 64)) {
            const std::string whose = fmt::format("buffer {}", buffers.size());
            Json buffer = {{"byteLength", wholeOf(item, "byteLength", 0, limits_.buffer_bytes, whose)}};
            if (buffer["byteLength"] == 0) fail(whose + " is empty");
            if (const auto uri = item.find("uri"); uri != item.end()) {
                if (!uri->is_string()) fail(whose + ": `uri` is no string");
                buffer["uri"] = *uri;
            }
            buffers.push_back(std::move(buffer));
        }
        return buffers;
    }

    Json viewsOf(const Json& document, std::size_t buffers) const {
        Json views = Json::array();
        for (const Json& item : listOf(document, "bufferViews", limits_.accessors)) {
            const std::string whose = fmt::format("buffer view {}", views.size());
            const auto buffer = indexIn(item, "buffer", buffers, whose);
            if (!buffer) fail(whose + " names no buffer");
            Json view = {{"buffer", *buffer},
                         {"byteOffset", wholeOf(item, "byteOffset", 0, limits_.buffer_bytes, whose)},
                         {"byteLength", wholeOf(item, "byteLength", 0, limits_.buffer_bytes, whose)}};
            if (const std::uint64_t stride = wholeOf(item, "byteStride", 0, 252, whose))
                view["byteStride"] = stride;
            views.push_back(std::move(view));
        }
        return views;
    }

    Json accessorsOf(const Json& document, std::size_t views) const {
        Json accessors = Json::array();
        for (const Json& item : listOf(document, "accessors", limits_.accessors)) {
            const std::string whose = fmt::format("accessor {}", accessors.size());
            Json accessor = {{"count", wholeOf(item, "count", 0, limits_.elements, whose)},
                             {"componentType", wholeOf(item, "componentType", 0, 0xffff, whose)},
                             {"byteOffset", wholeOf(item, "byteOffset", 0, limits_.buffer_bytes, whose)}};
            const auto type = item.find("type");
            if (type == item.end() || !type->is_string()) fail(whose + ": `type` is no string");
            accessor["type"] = *type;
            // Those of no geometry may lack one (and be sparse): they are not read.
            if (const auto view = indexIn(item, "bufferView", views, whose); view && !item.contains("sparse"))
                accessor["bufferView"] = *view;
            accessors.push_back(std::move(accessor));
        }
        return accessors;
    }

    Json meshesOf(const Json& document, const Json& accessors) const {
        Json meshes = Json::array();
        std::size_t primitives = 0;
        for (const Json& item : listOf(document, "meshes", limits_.nodes)) {
            Json mesh = {{"primitives", Json::array()}};
            addName(item, mesh);
            const std::string whose = fmt::format("mesh {}", meshes.size());
            for (const Json& source : listOf(item, "primitives", limits_.primitives)) {
                if (++primitives > limits_.primitives)
                    fail(fmt::format("has more than the {} primitives that can be", limits_.primitives));
                Json primitive = {{"mode", wholeOf(source, "mode", 4, 6, whose)},
                                  {"attributes", Json::object()}};
                if (const auto extensions = source.find("extensions");
                    extensions != source.end() && extensions->is_object() &&
                    extensions->contains("KHR_draco_mesh_compression"))
                    fail(whose + " is compressed (KHR_draco_mesh_compression): export it without");
                if (const auto indices = storedIn(source, "indices", accessors, whose))
                    primitive["indices"] = *indices;
                if (const auto attributes = source.find("attributes");
                    attributes != source.end() && attributes->is_object())
                    for (const char* name : {"POSITION", "NORMAL"})
                        if (const auto index = storedIn(*attributes, name, accessors, whose))
                            primitive["attributes"][name] = *index;
                mesh["primitives"].push_back(std::move(primitive));
            }
            meshes.push_back(std::move(mesh));
        }
        return meshes;
    }

    std::optional<std::size_t> storedIn(const Json& item, const char* key, const Json& accessors,
                                        const std::string& whose) const {
        const auto index = indexIn(item, key, accessors.size(), whose);
        if (index && !accessors[*index].contains("bufferView"))
            fail(fmt::format("{}: accessor {} has no buffer view, or is sparse: that is not read", whose,
                             *index));
        return index;
    }

    static void addName(const Json& source, Json& target) {
        if (const auto name = source.find("name"); name != source.end() && name->is_string())
            target["name"] = *name;
    }

    Json nodesOf(const Json& document, std::size_t meshes) const {
        const Json& sources = listOf(document, "nodes", limits_.nodes);
        Json nodes = Json::array();
        std::set<std::size_t> has_parent;
        for (const Json& item : sources) {
            const std::string whose = fmt::format("node {}", nodes.size());
            Json node = Json::object();
            addName(item, node);
            if (const auto mesh = indexIn(item, "mesh", meshes, whose)) node["mesh"] = *mesh;
            for (const auto& [key, count] :
                 {std::pair{"matrix", 16u}, {"translation", 3u}, {"rotation", 4u}, {"scale", 3u}})
                if (const auto values = item.find(key); values != item.end())
                    node[key] = numbersOf(*values, count, whose, key);
            if (const auto children = item.find("children"); children != item.end()) {
                if (!children->is_array()) fail(whose + ": `children` is no array");
                for (const Json& child : *children) {
                    const std::size_t index = checkedIndex(child, "children", sources.size(), whose);
                    if (!has_parent.insert(index).second)
                        fail(fmt::format("node {} has more than one parent", index));
                    node["children"].push_back(index);
                }
            }
            nodes.push_back(std::move(node));
        }
        checkForCycles(nodes, has_parent);
        return nodes;
    }

    Json numbersOf(const Json& values, std::size_t count, const std::string& whose, const char* key) const {
        bool sound = values.is_array() && values.size() == count;
        if (sound)
            for (const Json& value : values)
                sound = sound && value.is_number() && std::abs(value.get<double>()) <= 1.0e12;
        if (!sound) fail(fmt::format("{}: `{}` is not {} numbers", whose, key, count));
        return values;
    }

    /// As no node has two parents, those in a cycle are the ones that no root leads to.
    void checkForCycles(const Json& nodes, const std::set<std::size_t>& has_parent) const {
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (!has_parent.contains(i)) open.push_back(i);
        std::size_t reached = 0;
        for (; !open.empty(); ++reached) {
            const Json& node = nodes[open.back()];
            open.pop_back();
            if (const auto children = node.find("children"); children != node.end())
                for (const Json& child : *children)
                    open.push_back(child.get<std::size_t>());
        }
        if (reached != nodes.size()) fail("its nodes form a cycle");
    }

    Json scenesOf(const Json& document, std::size_t nodes) const {
        Json scenes = Json::array();
        for (const Json& item : listOf(document, "scenes", 1000)) {
            const std::string whose = fmt::format("scene {}", scenes.size());
            Json scene = {{"nodes", Json::array()}};
            if (const auto roots = item.find("nodes"); roots != item.end()) {
                if (!roots->is_array()) fail("the nodes of a scene are no array");
                std::set<std::size_t> known;
                for (const Json& root : *roots) {
                    const std::size_t node = checkedIndex(root, "nodes", nodes, whose);
                    if (!known.insert(node).second) fail(fmt::format("{} lists node {} twice", whose, node));
                    scene["nodes"].push_back(node);
                }
            }
            scenes.push_back(std::move(scene));
        }
        return scenes;
    }

    struct Folder {
        fs::path path;
        std::uint64_t limit;
    };
    static bool readExternal(std::vector<unsigned char>* out, std::string* problem, const std::string& name,
                             void* context) {
        const auto& folder = *static_cast<const Folder*>(context);
        try {
            *out = readBeneath(folder.path, name, folder.limit);
            return true;
        } catch (const InputError& error) {
            if (problem) *problem = error.what();
            return false;
        }
    }

    void parse(const std::string& json, const Parts& parts, tinygltf::Model& model) const {
        Folder folder{path_.parent_path(), limits_.buffer_bytes};
        tinygltf::FsCallbacks files{};
        files.FileExists = [](const std::string&, void*) { return true; };  // reading will tell
        files.ExpandFilePath = [](const std::string& name, void*) { return name; };
        files.ReadWholeFile = readExternal;
        files.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                                  void*) { return false; };
        files.user_data = &folder;
        tinygltf::TinyGLTF parser;
        parser.SetFsCallbacks(files);
        parser.RemoveImageLoader();
        std::string problem, warning;
        bool sound = false;
        try {
            if (parts.is_glb) {
                const std::string bytes = glbOf(json, parts.binary);
                sound = parser.LoadBinaryFromMemory(&model, &problem, &warning,
                                                    reinterpret_cast<const unsigned char*>(bytes.data()),
                                                    static_cast<unsigned int>(bytes.size()), "");
            } else {
                sound = parser.LoadASCIIFromString(&model, &problem, &warning, json.data(),
                                                   static_cast<unsigned int>(json.size()), "");
            }
        } catch (const std::exception& error) {
            problem += error.what();
        }
        while (!problem.empty() && (problem.back() == '\n' || problem.back() == ' '))
            problem.pop_back();
        if (!sound) fail(problem.empty() ? "is not glTF" : problem);
    }

    static std::string glbOf(std::string json, std::string_view binary) {
        json.resize((json.size() + 3) / 4 * 4, ' ');
        const std::size_t padded = (binary.size() + 3) / 4 * 4;
        std::string bytes;
        bytes.reserve(28 + json.size() + padded);
        appendWord(bytes, kGlb);
        appendWord(bytes, 2);
        appendWord(bytes, static_cast<std::uint32_t>(20 + json.size() + (padded ? 8 + padded : 0)));
        appendWord(bytes, static_cast<std::uint32_t>(json.size()));
        appendWord(bytes, kJsonChunk);
        bytes += json;
        if (padded == 0) return bytes;
        appendWord(bytes, static_cast<std::uint32_t>(padded));
        appendWord(bytes, kBinaryChunk);
        bytes += binary;
        bytes.resize(bytes.size() + padded - binary.size(), '\0');
        return bytes;
    }

    void checkAccessors(const tinygltf::Model& model) const {
        for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
            const tinygltf::BufferView& view = model.bufferViews[i];
            const std::size_t there = model.buffers.at(static_cast<std::size_t>(view.buffer)).data.size();
            if (view.byteOffset > there || view.byteLength > there - view.byteOffset)
                fail(fmt::format("buffer view {} reaches {} bytes into a buffer of {}", i,
                                 view.byteOffset + view.byteLength, there));
        }
        for (std::size_t i = 0; i < model.accessors.size(); ++i)
            if (model.accessors[i].bufferView >= 0) checkAccessor(model, i);
    }

    void checkAccessor(const tinygltf::Model& model, std::size_t i) const {
        const tinygltf::Accessor& accessor = model.accessors[i];
        const tinygltf::BufferView& view =
            model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
        const int component =
            tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
        const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
        if (component <= 0 || components <= 0) fail(fmt::format("accessor {} has an unknown type", i));
        const auto item = static_cast<std::uint64_t>(component) * static_cast<std::uint64_t>(components);
        const std::uint64_t stride = view.byteStride ? view.byteStride : item;
        if (stride < item) fail(fmt::format("accessor {}: its items overlap", i));
        const std::uint64_t end =
            accessor.byteOffset + (accessor.count ? stride * (accessor.count - 1) + item : 0);
        if (end > view.byteLength)
            fail(fmt::format("accessor {} reaches {} bytes into a buffer view of {}", i, end,
                             view.byteLength));
    }

    const fs::path& path_;
    const GltfLimits& limits_;
};

}  // namespace

std::unique_ptr<tinygltf::Model> loadCheckedGltf(const fs::path& path, const GltfLimits& limits) {
    return Loader(path, limits).load();
}

}  // namespace throng::io
