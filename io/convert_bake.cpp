// SPDX-License-Identifier: Apache-2.0
#include "io/convert_bake.h"

#include <string>
#include <vector>

#include "base/build_name.h"
#include "base/files/hash.h"
#include "base/files/output_file.h"
#include "io/bake_copy.h"
#include "io/bake_folder.h"
#include "io/manifest.h"
#include "io/streams/stream_files.h"

namespace throng::io {
namespace {

/// @returns false when it was stopped
bool writeStreams(CrowdReader& source, std::vector<StreamFiles>& files, const ConvertOptions& options) {
    for (std::uint32_t frame = 0; frame < source.frames(); ++frame) {
        const CrowdFrame held = source.frame(frame);
        for (StreamFiles& stream : files)
            stream.append(held[stream.info().id]);
        if (!options.go_on(frame + 1)) return false;
    }
    for (StreamFiles& stream : files)
        stream.finish();
    return true;
}

/// The source's list with the streams of the new bake where those of the source were.
std::vector<std::string> copyTheRest(const Bake& bake, const std::vector<StreamFiles>& streams,
                                     const std::filesystem::path& folder) {
    std::vector<std::string> paths;
    bool has_streams = false;
    const auto addStreams = [&] {
        for (const std::string& path : filesOf(streams))
            paths.push_back(path);
        has_streams = true;
    };
    for (const Bake::File& file : bake.files) {
        if (isStreamFile(file.path)) {
            if (!has_streams) addStreams();
            continue;
        }
        copyBakeFile(bake, file.path, folder);
        paths.push_back(file.path);
    }
    if (!has_streams) addStreams();
    return paths;
}

}  // namespace

std::optional<std::filesystem::path> convertBake(CrowdReader& source, const ConvertOptions& options) {
    const Bake& bake = source.bake();
    BakeFolder folder(options.output, options.force);
    folder.addFolder("streams");
    requireInside(bake, {});
    requireSound(bake,
                 [&](const std::string& path) { return !isStreamFile(path) || isReadStream(bake, path); });
    std::vector<StreamFiles> streams;
    for (const StreamInfo& info : kStreams)
        if (bake.streams[info.id])
            streams.emplace_back(folder.path(), info, options.formats, bake.agents, bake.frames);
    if (!writeStreams(source, streams, options)) return std::nullopt;

    nlohmann::ordered_json manifest = bake.manifest;
    manifest["generator"] = "throng " THRONG_VERSION;
    manifest["build"] = buildName();
    manifest["inputs"] =
        "xxh3:" + hashText(manifest.value("inputs", "") + "\nstreams as " + wordsOf(options.formats));
    manifest["streams"] = streamsToJson(bake.streams, options.formats);
    manifest["files"] = listOfFiles(folder.path(), copyTheRest(bake, streams, folder.path()));
    writeFile(folder.path() / "bake.json", manifestText(std::move(manifest)));
    return folder.commit();
}

}  // namespace throng::io
