// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "authoring/layout/layout_reader.h"
#include "authoring/overrides/matching.h"
#include "authoring/overrides/overrides_reader.h"
#include "base/files/hash.h"
#include "base/files/input_file.h"
#include "cli/commands.h"
#include "cli/terminal/exit_codes.h"
#include "cli/terminal/failure.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/say.h"
#include "io/bake_info.h"
#include "io/overrides/agent_table_edit.h"
#include "io/overrides/apply_layers.h"
#include "io/overrides/apply_overrides.h"

namespace throng::cli {
namespace fs = std::filesystem;
namespace {

using authoring::Match;
using authoring::Override;
using Json = nlohmann::ordered_json;

struct ApplyOptions {
    std::string bake;
    std::string file;
    std::string output;
    std::string gltf = "auto";
    std::uint32_t gltf_agents = 2000;
    bool force = false;
    bool strict = false;
    bool dry_run = false;
    bool json = false;
    bool quiet = false;
};

/// `NAME.overrides.json` beside the bake `NAME`: not in it, as a bake made again replaces its folder.
fs::path overridesBeside(const io::Bake& bake) {
    fs::path folder = fs::absolute(bake.folder).lexically_normal();
    if (!folder.has_filename()) folder = folder.parent_path();
    return folder.string() + ".overrides.json";
}

/// A file of overrides, whom its entries mean, and what its layers came to.
struct Loaded {
    fs::path path;
    std::string text;
    std::vector<Override> overrides;
    std::vector<authoring::Layer> layers;
    std::vector<authoring::Entrant> people;
    std::vector<Match> matches;
    std::vector<io::LayerResult> results;  ///< of the layers

    std::size_t count(Match::Kind kind) const {
        std::size_t found = 0;
        for (const Match& match : matches)
            found += match.kind == kind;
        return found;
    }
    /// Layers that ought to do something and mean nobody.
    std::size_t emptyLayers() const {
        std::size_t found = 0;
        for (std::size_t i = 0; i < layers.size(); ++i)
            found += layers[i].enabled && results[i].rows.empty();
        return found;
    }
};

Loaded load(const ApplyOptions& options, const io::CrowdReader& crowd) {
    Loaded loaded;
    loaded.path = options.file.empty() ? overridesBeside(crowd.bake()) : fs::path(options.file);
    loaded.text = readFile(loaded.path);
    authoring::Diagnostics diagnostics;
    diagnostics.file = loaded.path.string();
    const auto file = authoring::readOverrides(loaded.text, diagnostics);
    for (const authoring::Diagnostic& entry : diagnostics.entries)
        say(stderr, "{}\n", authoring::formatDiagnostic(entry, diagnostics.file, loaded.text));
    if (!file) throw Exit(kInvalidInput, "the overrides are not valid", diagnosticsJson(diagnostics));
    loaded.overrides = file->people;
    loaded.layers = file->layers;
    loaded.people = io::loadEntrants(crowd);
    loaded.matches = authoring::matchOverrides(loaded.overrides, loaded.people);
    return loaded;
}

std::string changesOf(const Override& entry) {
    return fmt::format("{}", fmt::join(authoring::changeWords(entry.change), ", "));
}

const char* wordFor(Match::Kind kind) {
    return kind == Match::Kind::sure ? "sure" : kind == Match::Kind::nearest ? "nearest" : "orphaned";
}

/// "layer `thin`: 12 people: hide": what came of one.
std::string layerLine(const Loaded& loaded, std::size_t index) {
    const authoring::Layer& layer = loaded.layers[index];
    if (!layer.enabled) return fmt::format("layer `{}` is not enabled", layer.name);
    const io::LayerResult& result = loaded.results[index];
    std::string line = fmt::format("layer `{}`: {} {}: {}", layer.name, result.rows.size(),
                                   result.rows.size() == 1 ? "person" : "people",
                                   fmt::join(authoring::operationWords(layer.operations), ", "));
    if (result.copies) line += fmt::format(" ({} copies)", result.copies);
    return line;
}

/// @param with_rows whom each means, by row
Json layersJson(const Loaded& loaded, bool with_rows) {
    Json list = Json::array();
    for (std::size_t i = 0; i < loaded.layers.size(); ++i) {
        const authoring::Layer& layer = loaded.layers[i];
        Json item = {{"layer", layer.name},
                     {"enabled", layer.enabled},
                     {"people", loaded.results[i].rows.size()},
                     {"copies", loaded.results[i].copies},
                     {"changes", authoring::operationWords(layer.operations)},
                     {"remarks", loaded.results[i].remarks}};
        if (loaded.layers[i].operations.bend) {
            item["sharp_bends"] = Json::array();
            for (const io::SharpBend& each : loaded.results[i].sharp)
                item["sharp_bends"].push_back(
                    {{"row", each.row}, {"acceleration", each.acceleration}, {"frame", each.frame}});
        }
        if (with_rows) item["rows"] = loaded.results[i].rows;
        list.push_back(std::move(item));
    }
    return list;
}

void printListing(const Loaded& loaded) {
    for (std::size_t i = 0; i < loaded.matches.size(); ++i) {
        const Match& match = loaded.matches[i];
        const Override& entry = loaded.overrides[i];
        std::string who = fmt::format("{} {} of `{}`", wordFor(match.kind), entry.id, entry.group);
        if (match.kind == Match::Kind::nearest)
            who += fmt::format(" is now {}, {:.2f} m and {:+.0f} frames away", match.row, match.metres,
                               match.frames);
        if (match.kind == Match::Kind::orphaned) who += ": " + authoring::orphanReason(entry, loaded.people);
        say(stdout, "{}: {}\n", who, changesOf(entry));
    }
    for (std::size_t i = 0; i < loaded.layers.size(); ++i)
        say(stdout, "{}\n", layerLine(loaded, i));
}

Json matchesJson(const Loaded& loaded) {
    Json list = Json::array();
    for (std::size_t i = 0; i < loaded.matches.size(); ++i) {
        const Match& match = loaded.matches[i];
        const Override& entry = loaded.overrides[i];
        Json item = {{"id", entry.id},
                     {"group", entry.group},
                     {"match", wordFor(match.kind)},
                     {"changes", authoring::changeWords(entry.change)}};
        if (match.kind == Match::Kind::orphaned) {
            item["reason"] = authoring::orphanReason(entry, loaded.people);
        } else {
            item["row"] = match.row;
            item["metres"] = match.metres;
            item["frames"] = match.frames;
            if (entry.change.scale) item["scale"] = *entry.change.scale;
            if (entry.change.tint) item["tint"] = entry.change.tint->text;
            if (!entry.change.hero.empty()) item["hero"] = entry.change.hero;
        }
        list.push_back(std::move(item));
    }
    return list;
}

/// Entries, then layers.
Json listingJson(const Loaded& loaded) {
    Json list = matchesJson(loaded);
    for (Json& layer : layersJson(loaded, true))
        list.push_back(std::move(layer));
    return list;
}

Json appliedJson(const Loaded& loaded, const io::Bake& bake) {
    Json applied = {{"overrides", loaded.path.filename().string()},
                    {"xxh3", hashText(loaded.text)},
                    {"source", bake.folder.filename().string()},
                    {"entries", matchesJson(loaded)}};
    if (!loaded.layers.empty()) applied["layers"] = layersJson(loaded, false);
    return applied;
}

void tellOrphans(const Loaded& loaded) {
    for (std::size_t i = 0; i < loaded.matches.size(); ++i)
        if (loaded.matches[i].kind == Match::Kind::orphaned)
            say(stderr, "throng: {}:{}: the override of person {} is orphaned: {}\n", loaded.path.string(),
                loaded.overrides[i].where.line, loaded.overrides[i].id,
                authoring::orphanReason(loaded.overrides[i], loaded.people));
}

void tellRemarks(const Loaded& loaded) {
    for (std::size_t i = 0; i < loaded.layers.size(); ++i)
        for (const std::string& remark : loaded.results[i].remarks)
            say(stderr, "throng: {}:{}: the layer `{}`: {}\n", loaded.path.string(),
                loaded.layers[i].where.line, loaded.layers[i].name, remark);
}

void printOverlaps(const std::vector<io::Overlap>& overlaps) {
    constexpr std::size_t kMostTold = 10;
    if (overlaps.empty()) return;
    say(stdout, "{} pairs are in each other where they were not before, the deepest:\n", overlaps.size());
    for (std::size_t i = 0; i < std::min(overlaps.size(), kMostTold); ++i)
        say(stdout, "  {} and {}: frames {} to {}, {:.2f} m in frame {}\n", overlaps[i].row,
            overlaps[i].other, overlaps[i].first, overlaps[i].last, overlaps[i].depth, overlaps[i].deepest);
}

void printResult(const ApplyOptions& options, const Loaded& loaded, const io::ApplyResult& result) {
    if (options.json) {
        sayJson(io::infoJson(io::loadBake(result.path)));
        return;
    }
    say(stdout, "{}: {} overrides applied ({} sure, {} by the nearest entry), {} orphaned\n",
        result.path.string(), loaded.matches.size() - loaded.count(Match::Kind::orphaned),
        loaded.count(Match::Kind::sure), loaded.count(Match::Kind::nearest),
        loaded.count(Match::Kind::orphaned));
    for (std::size_t i = 0; i < loaded.layers.size(); ++i)
        say(stdout, "{}\n", layerLine(loaded, i));
    printOverlaps(result.overlaps);
    for (std::size_t i = 0; i < std::min<std::size_t>(result.in_walls.size(), 10); ++i)
        say(stdout, "{} is in the wall `{}`, where it was not before: frames {} to {}\n",
            result.in_walls[i].row, result.in_walls[i].wall, result.in_walls[i].first,
            result.in_walls[i].last);
    if (result.held)
        say(stdout, "{} retimed people stand still where the bake has no frames for them\n", result.held);
}

void write(const ApplyOptions& options, io::LayeredCrowd& crowd, const Loaded& loaded) {
    const io::Bake& bake = crowd.bake();
    std::error_code absent;
    if (fs::equivalent(bake.folder, options.output, absent))
        throw OutputError(options.output, "is the bake that is read; give another name");
    const InterruptGuard interrupt;
    Progress progress(progressStyle(options.quiet, options.json), bake.frames, 0, 1);
    io::ApplyOptions apply;
    apply.output = options.output;
    apply.force = options.force;
    apply.gltf =
        options.gltf == "yes" || (options.gltf == "auto" && !bake.manifest.value("gltf", Json()).is_null());
    apply.gltf_agents = options.gltf_agents;
    apply.watch_overlaps = !loaded.layers.empty();
    apply.identity = loaded.text;
    apply.applied = appliedJson(loaded, bake);
    apply.go_on = [&](std::uint32_t frames) {
        progress.update(frames, bake.agents, frames);
        return interrupt.signal() == 0;
    };
    const std::optional<io::ApplyResult> result = io::writeApplied(crowd, apply);
    if (!result) {
        say(stderr, "throng: stopped; nothing was written\n");
        throw Exit(128 + interrupt.signal(), "stopped; nothing was written");
    }
    printResult(options, loaded, *result);
}

/// Overrides first, then the layers.
void change(io::LayeredCrowd& crowd, Loaded& loaded) {
    std::vector<io::RowChange> changes;
    for (std::size_t i = 0; i < loaded.matches.size(); ++i)
        if (loaded.matches[i].kind != Match::Kind::orphaned && !loaded.overrides[i].change.changesNothing())
            changes.push_back({loaded.matches[i].row, loaded.overrides[i].change});
    io::changeRows(crowd, changes);
    loaded.results = io::applyLayers(crowd, loaded.layers, loaded.people);
}

void runApply(const ApplyOptions& options) {
    io::CrowdReader reader(io::loadBake(options.bake));
    Loaded loaded = load(options, reader);
    io::LayeredCrowd crowd(reader);
    change(crowd, loaded);
    const std::size_t orphans = loaded.count(Match::Kind::orphaned), empty = loaded.emptyLayers();
    const bool missed = options.strict && orphans + empty > 0;
    tellRemarks(loaded);
    if (options.dry_run) {
        if (options.json)
            sayJson(listingJson(loaded));
        else
            printListing(loaded);
    } else {
        tellOrphans(loaded);
        if (!missed) write(options, crowd, loaded);
    }
    if (!missed) return;
    std::string why;
    if (orphans) why = fmt::format("{} of {} overrides are orphaned", orphans, loaded.matches.size());
    if (empty)
        why += fmt::format("{}{} of {} layers mean nobody", orphans ? ", " : "", empty, loaded.layers.size());
    why += " (--strict)";
    say(stderr, "throng: {}\n", why);
    throw options.dry_run ? Exit(kInvalidInput) : Exit(kInvalidInput, why);
}

}  // namespace

void addApply(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("apply", "Write a bake anew with changes to its people (overrides and layers)");
    auto options = std::make_shared<ApplyOptions>();
    command->add_option("bake", options->bake, "A bake's folder, or its bake.json")->required();
    command->add_option("--overrides", options->file,
                        "The changes; by default BAKE.overrides.json beside the bake");
    CLI::Option* output = command->add_option("-o,--output", options->output, "The bake to make");
    command->add_flag("--force", options->force, "Replace an existing bake");
    command->add_flag("--strict", options->strict, "Write nothing when an override or a layer finds nobody");
    CLI::Option* dry_run =
        command->add_flag("--dry-run", options->dry_run, "Only tell whom each override and each layer finds");
    command->add_option("--gltf", options->gltf, "Write crowd.glb: yes, no, or auto (as the bake has one)")
        ->check(CLI::IsMember({"auto", "yes", "no"}))
        ->capture_default_str();
    command->add_option("--gltf-agents", options->gltf_agents, "At most this many people in crowd.glb")
        ->capture_default_str();
    command->add_flag("--json", options->json,
                      "Progress as JSON lines on stderr, the result as a JSON document on stdout");
    command->add_flag("-q,--quiet", options->quiet, "No progress");
    command->footer(
        "Ctrl-C leaves nothing behind. `throng schema --overrides` prints the format of the file.\n\n"
        "Example:\n  throng apply bakes/street -o bakes/street-final");
    command->callback([options, output, dry_run] {
        if (output->count() == 0 && dry_run->count() == 0)
            throw CLI::RequiredError("--output (or --dry-run)");
        runApply(*options);
    });
}

}  // namespace throng::cli
