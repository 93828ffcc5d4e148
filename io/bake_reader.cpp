// SPDX-License-Identifier: Apache-2.0
#include "io/bake_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/files/input_file.h"

namespace throng::io {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

/// Reads members of the manifest; every error names the file and the member.
class ManifestReader {
  public:
    ManifestReader(const fs::path& path, const Json& json) : path_(path), json_(json) {}

    [[noreturn]] void fail(const std::string& pointer, const char* expected) const {
        throw InputError(path_, fmt::format("`{}` is missing or not {}", pointer, expected));
    }

    bool has(const std::string& pointer) const { return json_.contains(Json::json_pointer(pointer)); }
    const Json& at(const std::string& pointer) const {
        const Json::json_pointer where(pointer);
        if (!json_.contains(where)) fail(pointer, "what it should be");
        return json_.at(where);
    }
    const Json& list(const std::string& pointer) const {
        const Json& value = at(pointer);
        if (!value.is_array()) fail(pointer, "a list");
        return value;
    }
    std::string text(const std::string& pointer) const {
        const Json& value = at(pointer);
        if (!value.is_string()) fail(pointer, "a text");
        return value.get<std::string>();
    }
    bool flag(const std::string& pointer) const {
        const Json& value = at(pointer);
        if (!value.is_boolean()) fail(pointer, "true or false");
        return value.get<bool>();
    }
    double number(const std::string& pointer) const {
        const Json& value = at(pointer);
        if (!value.is_number() || !std::isfinite(value.get<double>())) fail(pointer, "a number");
        return value.get<double>();
    }
    std::uint64_t count(const std::string& pointer, std::uint64_t largest) const {
        const Json& value = at(pointer);
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() > largest) fail(pointer, "a count");
        return value.get<std::uint64_t>();
    }
    std::uint32_t count(const std::string& pointer) const {
        return static_cast<std::uint32_t>(count(pointer, 0xffffffffu));
    }
    glm::dvec2 point(const std::string& pointer) const {
        return {number(pointer + "/0"), number(pointer + "/1")};
    }
    std::vector<glm::dvec2> points(const std::string& pointer) const {
        std::vector<glm::dvec2> result;
        for (std::size_t i = 0; i < list(pointer).size(); ++i)
            result.push_back(point(fmt::format("{}/{}", pointer, i)));
        return result;
    }

  private:
    const fs::path& path_;
    const Json& json_;
};

Json parseManifest(const fs::path& path) {
    try {
        return Json::parse(readFile(path));
    } catch (const nlohmann::json::exception& error) {
        throw InputError(path, std::string("not a manifest: ") + error.what());
    }
}

void readGeometry(const ManifestReader& reader, Bake& bake) {
    for (std::size_t i = 0; i < reader.list("/geometry/roads").size(); ++i) {
        const std::string at = fmt::format("/geometry/roads/{}", i);
        bake.roads.push_back({reader.text(at + "/id"),
                              reader.points(at + "/centreline"),
                              reader.number(at + "/width"),
                              reader.flag(at + "/one_way"),
                              {}});
    }
    for (std::size_t i = 0; i < reader.list("/geometry/areas").size(); ++i) {
        const std::string at = fmt::format("/geometry/areas/{}", i);
        bake.areas.push_back({reader.text(at + "/id"), reader.points(at + "/polygon"), {}});
    }
    for (std::size_t i = 0; i < reader.list("/geometry/walls").size(); ++i) {
        const std::string at = fmt::format("/geometry/walls/{}", i);
        authoring::Wall wall;
        wall.id = reader.text(at + "/id");
        wall.points = reader.points(at + "/points");
        wall.closed = reader.flag(at + "/closed");
        wall.thickness = reader.number(at + "/thickness");
        wall.height = reader.number(at + "/height");
        if (reader.has(at + "/gate")) {
            wall.open_at_start = reader.flag(at + "/gate/open_at_start");
            for (std::size_t k = 0; k < reader.list(at + "/gate/toggles").size(); ++k)
                wall.toggles.push_back(reader.number(fmt::format("{}/gate/toggles/{}", at, k)));
        }
        bake.walls.push_back(std::move(wall));
    }
}

/// A manifest may come from anywhere: nothing outside its folder is read because of what it says.
bool staysInside(const std::string& path) {
    const fs::path relative(path);
    return !path.empty() && relative.is_relative() &&
           std::ranges::none_of(relative, [](const fs::path& part) { return part == ".."; });
}

/// Those that the manifest does not name are there where every such bake has them.
StreamChoice readStreams(const ManifestReader& reader) {
    StreamChoice asked;
    for (const StreamInfo& info : kStreams)
        asked[info.id] = reader.has(fmt::format("/streams/{}", info.name));
    return streamsOf(reader.has("/terrain"), asked);
}

void readFiles(const ManifestReader& reader, Bake& bake) {
    for (std::size_t i = 0; i < reader.list("/files").size(); ++i) {
        const std::string at = fmt::format("/files/{}", i);
        Bake::File file{reader.text(at + "/path"), reader.count(at + "/bytes", ~std::uint64_t{0}),
                        reader.text(at + "/xxh3")};
        if (!staysInside(file.path)) reader.fail(at + "/path", "a path inside the bake");
        bake.files.push_back(std::move(file));
    }
}

}  // namespace

Bake loadBake(const fs::path& path) {
    const fs::path manifest_path = fs::is_directory(path) ? path / "bake.json" : path;
    Bake bake;
    bake.folder = manifest_path.has_parent_path() ? manifest_path.parent_path() : fs::path(".");
    bake.manifest = parseManifest(manifest_path);
    const ManifestReader reader(manifest_path, bake.manifest);
    if (!bake.manifest.is_object() || bake.manifest.value("format", Json()) != "throng bake")
        throw InputError(manifest_path, "not the manifest of a bake");
    if (reader.count("/version") != 1)
        throw InputError(manifest_path, "written by a newer version of Throng: its `version` is not 1");
    bake.name = reader.text("/name");
    bake.complete = reader.flag("/complete");
    bake.fps = reader.number("/fps");
    if (bake.fps <= 0.0) reader.fail("/fps", "more than 0");
    bake.frames = reader.count("/frames");
    bake.agents = reader.count("/agents");
    bake.seed = reader.count("/seed", ~std::uint64_t{0});
    bake.origin = reader.point("/origin");
    bake.minimum = reader.point("/bounds/min");
    bake.maximum = reader.point("/bounds/max");
    if (bake.minimum.x >= bake.maximum.x || bake.minimum.y >= bake.maximum.y)
        reader.fail("/bounds", "a rectangle with an area");
    readGeometry(reader, bake);
    bake.account = {reader.count("/account/agents"), reader.count("/account/spawned"),
                    reader.count("/account/walking"), reader.count("/account/arrived"),
                    reader.count("/account/refused")};
    bake.streams = readStreams(reader);
    readFiles(reader, bake);
    return bake;
}

}  // namespace throng::io
