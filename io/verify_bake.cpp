// SPDX-License-Identifier: Apache-2.0
#include "io/verify_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

#include "base/files/beneath.h"
#include "base/files/hash.h"
#include "io/bake_copy.h"
#include "io/checkpoint.h"
#include "io/manifest.h"
#include "io/streams/stream_reader.h"

namespace throng::io {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
using Kind = BakeProblem::Kind;

constexpr const char* kManifest = "bake.json";

/// Whether a manifest has a checksum for every file it should have one for.
bool listsChecksums(const Json& manifest) {
    if (!manifest.is_object() || !manifest.contains("files") || !manifest["files"].is_array()) return false;
    return std::ranges::all_of(manifest["files"],
                               [](const Json& file) { return file.is_object() && file.contains("xxh3"); });
}

std::string tidied(const std::string& path) {
    return fs::path(path).lexically_normal().generic_string();
}

/// Files below a folder that the list does not have; links are not followed.
class Strangers {
  public:
    explicit Strangers(const Bake& bake) : folder_(bake.folder), known_{kManifest} {
        for (const Bake::File& file : bake.files)
            known_.insert(tidied(file.path));
    }

    std::vector<BakeProblem> find() {
        look(folder_);
        std::ranges::sort(found_, {}, &BakeProblem::path);
        return std::move(found_);
    }

  private:
    void look(const fs::path& folder) {
        std::error_code error;
        for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
            const std::string path = it->path().lexically_relative(folder_).generic_string();
            std::error_code unknown;
            if (fs::is_directory(it->symlink_status(unknown)))
                look(it->path());
            else if (!known_.contains(path) && !(folder == folder_ && isCheckpoint(it->path())))
                found_.push_back({Kind::stranger, path, "is not in the list of bake.json"});
        }
        if (error)
            found_.push_back({Kind::unreadable, folder.lexically_relative(folder_).generic_string(),
                              "cannot be listed: " + error.message()});
    }

    fs::path folder_;
    std::set<std::string> known_;
    std::vector<BakeProblem> found_;
};

/// Streams that the bake says it has and whose files nobody could compare.
std::vector<BakeProblem> unlistedStreams(const Bake& bake) {
    std::vector<BakeProblem> found;
    for (const StreamInfo& info : kStreams)
        for (const StreamFormatInfo& format : kStreamFormats) {
            const std::string path = streamFile(info, format.id);
            std::error_code absent;
            if (bake.streams[info.id] && bake.formats.has(format.id) &&
                !fs::exists(bake.folder / path, absent) &&
                std::ranges::none_of(bake.files, [&](const Bake::File& file) { return file.path == path; }))
                found.push_back({Kind::unlisted, path, "missing, and not in the list of bake.json"});
        }
    return found;
}

void compareFiles(const Bake& bake, const VerifyProgress& progress, Verification& verification) {
    std::uint64_t read = 0, ended = 0;
    const auto advance = [&](std::uint64_t bytes) {
        read += bytes;
        if (progress) progress(std::min(read, verification.bytes), verification.bytes);
    };
    for (const Bake::File& file : bake.files) {
        if (auto problem = problemOf(bake, file, advance))
            verification.problems.push_back(std::move(*problem));
        read = ended += file.bytes;
    }
}

}  // namespace

const char* nameOf(BakeProblem::Kind kind) {
    switch (kind) {
        case Kind::missing:
            return "missing";
        case Kind::truncated:
            return "truncated";
        case Kind::too_long:
            return "too long";
        case Kind::changed:
            return "changed";
        case Kind::unreadable:
            return "unreadable";
        case Kind::stranger:
            return "stranger";
        case Kind::unlisted:
            return "unlisted";
    }
    return "";
}

std::optional<BakeProblem> problemOf(const Bake& bake, const Bake::File& file,
                                     const std::function<void(std::uint64_t bytes)>& advance) try {
    const fs::path path = bake.folder / file.path;
    std::error_code unknown;
    if (fs::symlink_status(path, unknown).type() == fs::file_type::not_found)
        return BakeProblem{Kind::missing, file.path, "missing"};
    const InputFile opened = openBeneath(bake.folder, file.path);
    if (opened.size() != file.bytes) {
        const bool is_short = opened.size() < file.bytes;
        return BakeProblem{is_short ? Kind::truncated : Kind::too_long, file.path,
                           fmt::format("{}: {} of {} bytes", is_short ? "truncated" : "too long",
                                       opened.size(), file.bytes)};
    }
    if (hashFile(opened, advance).xxh3 != file.xxh3)
        return BakeProblem{Kind::changed, file.path, "changed: its checksum is not the one in bake.json"};
    if (!isStreamFile(file.path)) return std::nullopt;
    const StreamReader stream(path);
    if (stream.frames() == bake.frames && stream.rows() == bake.agents) return std::nullopt;
    return BakeProblem{Kind::changed, file.path,
                       fmt::format("holds {} frames of {} people where bake.json says {} of {}",
                                   stream.frames(), stream.rows(), bake.frames, bake.agents)};
} catch (const InputError& error) {
    return BakeProblem{Kind::unreadable, file.path, error.reason()};
}

Verification verifyBake(const fs::path& path, const VerifyProgress& progress) {
    Verification verification;
    try {
        const ManifestFile manifest = readManifest(path);
        if (checkManifest(manifest.text, manifest.json) == OwnChecksum::wrong)
            verification.problems.push_back(
                {Kind::changed, kManifest, "changed: its checksum does not fit what it says"});
        verification.has_checksums = !verification.problems.empty() || listsChecksums(manifest.json);
        if (!verification.has_checksums) return verification;
        const Bake bake = loadBake(path);
        verification.files = bake.files.size();
        for (const Bake::File& file : bake.files)
            verification.bytes += file.bytes;
        compareFiles(bake, progress, verification);
        for (std::vector<BakeProblem> found : {unlistedStreams(bake), Strangers(bake).find()})
            std::ranges::move(found, std::back_inserter(verification.problems));
    } catch (const InputError& error) {
        std::error_code unknown;
        const bool is_there = fs::exists(error.path(), unknown);
        verification.problems.push_back(
            {is_there ? Kind::unreadable : Kind::missing, kManifest, is_there ? error.reason() : "missing"});
    }
    return verification;
}

}  // namespace throng::io
