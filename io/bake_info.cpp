// SPDX-License-Identifier: Apache-2.0
#include "io/bake_info.h"

#include <fmt/format.h>

#include "base/numbers.h"
#include "base/outcomes.h"

namespace throng::io {
namespace {

using Json = nlohmann::ordered_json;

/// A member of the manifest that is for show only and so may be missing.
std::string optionalText(const Json& manifest, const char* pointer) {
    const Json::json_pointer where(pointer);
    if (!manifest.contains(where)) return "unknown";
    const Json& value = manifest.at(where);
    return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string refusedReasons(const Bake& bake) {
    const Json::json_pointer where("/account/refused_reasons");
    std::string lines;
    if (!bake.manifest.contains(where) || !bake.manifest.at(where).is_object()) return lines;
    for (const auto& [reason, count] : bake.manifest.at(where).items())
        if (count.is_number_unsigned())
            lines +=
                fmt::format("              {} refused: {}\n", grouped(count.get<std::uint64_t>()), reason);
    return lines;
}

/// The layout's file, and what was set beside it.
std::string sourceOf(const Bake& bake) {
    const Json::json_pointer overrides("/layout/overrides");
    std::string line = bake.manifest.contains("/layout/source/file"_json_pointer)
                           ? " " + optionalText(bake.manifest, "/layout/source/file")
                           : "";
    if (bake.manifest.contains(overrides) && bake.manifest.at(overrides).is_array())
        for (const Json& each : bake.manifest.at(overrides))
            if (each.is_string()) line += " --set " + each.get<std::string>();
    return line.empty() ? "" : fmt::format("baked from:  {}\n", line);
}

std::string extras(const Bake& bake) {
    std::string lines;
    if (bake.manifest.contains("gltf") && bake.manifest["gltf"].is_object())
        lines +=
            fmt::format("glTF:         {} of {} people in {}\n", optionalText(bake.manifest, "/gltf/agents"),
                        optionalText(bake.manifest, "/gltf/of"), optionalText(bake.manifest, "/gltf/file"));
    if (bake.manifest.contains("diagrams") && bake.manifest["diagrams"].is_object())
        lines += fmt::format(
            "diagrams:     {}, {} x {} pixels, every {} frames\n",
            optionalText(bake.manifest, "/diagrams/count"), optionalText(bake.manifest, "/diagrams/width"),
            optionalText(bake.manifest, "/diagrams/height"), optionalText(bake.manifest, "/diagrams/every"));
    return lines;
}

}  // namespace

std::uint64_t totalBytes(const Bake& bake) {
    std::uint64_t total = 0;
    for (const Bake::File& file : bake.files)
        total += file.bytes;
    return total;
}

std::string infoText(const Bake& bake) {
    const glm::dvec2 size = bake.maximum - bake.minimum;
    std::string text;
    text += fmt::format("bake:         {} ({})\n", bake.folder.string(),
                        bake.complete ? "complete" : "INCOMPLETE: the bake was interrupted");
    text += fmt::format("layout:       {}, seed {}\n", bake.name, bake.seed);
    text += sourceOf(bake);
    text += fmt::format("frames:       {} at {} fps = {:.2f} s, {} steps per frame\n", grouped(bake.frames),
                        bake.fps, bake.frames / bake.fps, optionalText(bake.manifest, "/substeps"));
    text += fmt::format("people:       {}: {} {}, {} {}, {} {}\n", grouped(bake.account.agents),
                        grouped(bake.account.arrived), wordFor(Fate::arrived), grouped(bake.account.walking),
                        wordFor(Fate::walking), grouped(bake.account.refused), wordFor(Fate::refused));
    text += refusedReasons(bake);
    text += fmt::format(
        "site:         {:.1f} x {:.1f} m, {} roads, {} areas, {} walls, origin {:.3f} {:.3f}\n", size.x,
        size.y, bake.roads.size(), bake.areas.size(), bake.walls.size(), bake.origin.x, bake.origin.y);
    if (bake.manifest.contains("terrain"))
        text += fmt::format("terrain:      {}, from {:.1f} to {:.1f} m high\n",
                            optionalText(bake.manifest, "/terrain/source"),
                            bake.manifest.value("/terrain/lowest"_json_pointer, 0.0),
                            bake.manifest.value("/terrain/highest"_json_pointer, 0.0));
    text += extras(bake);
    text += fmt::format("streams:      as {}\n", wordsOf(bake.formats));
    text += fmt::format("files:        {}, {}\n", bake.files.size(), readableBytes(totalBytes(bake)));
    text +=
        fmt::format("made by:      {}, build {}, on {}\n", optionalText(bake.manifest, "/generator"),
                    optionalText(bake.manifest, "/build"), optionalText(bake.manifest, "/device/renderer"));
    return text;
}

Json infoJson(const Bake& bake) {
    Json json = bake.manifest;
    json.erase("geometry");
    json.erase("files");
    json.erase("checksum");  // of what is not all here
    json["path"] = bake.folder.string();
    json["file_count"] = bake.files.size();
    json["bytes"] = totalBytes(bake);
    return json;
}

}  // namespace throng::io
