// SPDX-License-Identifier: Apache-2.0
#include "io/bake_copy.h"

#include <algorithm>
#include <optional>
#include <set>

#include "base/files/beneath.h"
#include "base/files/hash.h"
#include "base/files/input_file.h"
#include "base/files/output_file.h"
#include "io/verify_bake.h"

namespace throng::io {

bool isStreamFile(const std::string& path) {
    for (const StreamInfo& info : kStreams)
        for (const StreamFormatInfo& format : kStreamFormats)
            if (path == streamFile(info, format.id)) return true;
    return false;
}

bool isReadStream(const Bake& bake, const std::string& path) {
    return std::ranges::any_of(kStreams, [&](const StreamInfo& info) {
        return bake.streams[info.id] && path == streamFile(info, bake.formats.preferred());
    });
}

void requireInside(const Bake& bake, const std::vector<std::string>& more) {
    std::set<std::string> paths(more.begin(), more.end());
    for (const Bake::File& file : bake.files)
        paths.insert(file.path);
    for (const StreamInfo& info : kStreams)
        if (bake.streams[info.id]) paths.insert(streamFile(info, bake.formats.preferred()));
    for (const std::string& path : paths)
        openBeneath(bake.folder, path);
}

void requireSound(const Bake& bake, const WhichFiles& which) {
    for (const Bake::File& file : bake.files) {
        const std::optional<BakeProblem> problem = which(file.path) ? problemOf(bake, file) : std::nullopt;
        if (problem) throw InputError(bake.folder / file.path, problem->message);
    }
}

void copyBakeFile(const Bake& bake, const std::string& path, const std::filesystem::path& folder) {
    const std::filesystem::path to = folder / path;
    makeFolder(to.parent_path());
    const InputFile from = openBeneath(bake.folder, path);
    OutputFile copy(to);
    std::vector<std::byte> piece(std::size_t{1} << 20);
    for (std::uint64_t at = 0; at < from.size(); at += piece.size()) {
        const std::size_t count = std::min<std::uint64_t>(piece.size(), from.size() - at);
        from.readAt(at, std::span(piece).first(count));
        copy.write(std::span<const std::byte>(piece).first(count));
    }
    copy.finish();
}

nlohmann::ordered_json listOfFiles(const std::filesystem::path& folder, std::span<const std::string> paths) {
    auto list = nlohmann::ordered_json::array();
    for (const std::string& path : paths) {
        const FileHash hash = hashFile(folder / path);
        list.push_back({{"path", path}, {"bytes", hash.bytes}, {"xxh3", hash.xxh3}});
    }
    return list;
}

}  // namespace throng::io
