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
#include "io/overrides/apply_overrides.h"

namespace throng::cli {
namespace fs = std::filesystem;
namespace {

using authoring::Match;
using authoring::Override;
using Json = nlohmann::ordered_json;

struct Options {
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

struct Layer {
    fs::path path;
    std::string text;
    std::vector<Override> overrides;
    std::vector<authoring::Entrant> people;
    std::vector<Match> matches;

    std::size_t count(Match::Kind kind) const {
        std::size_t found = 0;
        for (const Match& match : matches)
            found += match.kind == kind;
        return found;
    }
};

Layer readLayer(const Options& options, const io::CrowdReader& crowd) {
    Layer layer;
    layer.path = options.file.empty() ? overridesBeside(crowd.bake()) : fs::path(options.file);
    layer.text = readFile(layer.path);
    authoring::Diagnostics diagnostics;
    diagnostics.file = layer.path.string();
    const auto overrides = authoring::readOverrides(layer.text, diagnostics);
    for (const authoring::Diagnostic& entry : diagnostics.entries)
        say(stderr, "{}\n", authoring::formatDiagnostic(entry, diagnostics.file, layer.text));
    if (!overrides) throw Exit(kInvalidInput, "the overrides are not valid", diagnosticsJson(diagnostics));
    layer.overrides = *overrides;
    layer.people = io::loadEntrants(crowd);
    layer.matches = authoring::matchOverrides(layer.overrides, layer.people);
    return layer;
}

std::string changesOf(const Override& entry) {
    return fmt::format("{}", fmt::join(authoring::changeWords(entry.change), ", "));
}

const char* wordFor(Match::Kind kind) {
    return kind == Match::Kind::sure ? "sure" : kind == Match::Kind::nearest ? "nearest" : "orphaned";
}

void printListing(const Layer& layer) {
    for (std::size_t i = 0; i < layer.matches.size(); ++i) {
        const Match& match = layer.matches[i];
        const Override& entry = layer.overrides[i];
        std::string who = fmt::format("{} {} of `{}`", wordFor(match.kind), entry.id, entry.group);
        if (match.kind == Match::Kind::nearest)
            who += fmt::format(" is now {}, {:.2f} m and {:+.0f} frames away", match.row, match.metres,
                               match.frames);
        if (match.kind == Match::Kind::orphaned) who += ": " + authoring::orphanReason(entry, layer.people);
        say(stdout, "{}: {}\n", who, changesOf(entry));
    }
}

Json matchesJson(const Layer& layer) {
    Json list = Json::array();
    for (std::size_t i = 0; i < layer.matches.size(); ++i) {
        const Match& match = layer.matches[i];
        const Override& entry = layer.overrides[i];
        Json item = {{"id", entry.id},
                     {"group", entry.group},
                     {"match", wordFor(match.kind)},
                     {"changes", authoring::changeWords(entry.change)}};
        if (match.kind == Match::Kind::orphaned) {
            item["reason"] = authoring::orphanReason(entry, layer.people);
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

Json appliedJson(const Layer& layer, const io::Bake& bake) {
    return {{"overrides", layer.path.filename().string()},
            {"xxh3", hashText(layer.text)},
            {"source", bake.folder.filename().string()},
            {"entries", matchesJson(layer)}};
}

void tellOrphans(const Layer& layer) {
    for (std::size_t i = 0; i < layer.matches.size(); ++i)
        if (layer.matches[i].kind == Match::Kind::orphaned)
            say(stderr, "throng: {}:{}: the override of person {} is orphaned: {}\n", layer.path.string(),
                layer.overrides[i].where.line, layer.overrides[i].id,
                authoring::orphanReason(layer.overrides[i], layer.people));
}

void printResult(const Options& options, const Layer& layer, const io::ApplyResult& result) {
    if (options.json) {
        sayJson(io::infoJson(io::loadBake(result.path)));
        return;
    }
    say(stdout, "{}: {} overrides applied ({} sure, {} by the nearest entry), {} orphaned\n",
        result.path.string(), layer.matches.size() - layer.count(Match::Kind::orphaned),
        layer.count(Match::Kind::sure), layer.count(Match::Kind::nearest),
        layer.count(Match::Kind::orphaned));
    if (result.held)
        say(stdout, "{} retimed people stand still where the bake has no frames for them\n", result.held);
}

void write(const Options& options, io::CrowdReader& crowd, const Layer& layer) {
    const io::Bake& bake = crowd.bake();
    std::error_code absent;
    if (fs::equivalent(bake.folder, options.output, absent))
        throw OutputError(options.output, "is the bake that is read; give another name");
    std::vector<io::RowChange> changes;
    for (std::size_t i = 0; i < layer.matches.size(); ++i)
        if (layer.matches[i].kind != Match::Kind::orphaned && !layer.overrides[i].change.changesNothing())
            changes.push_back({layer.matches[i].row, layer.overrides[i].change});

    const InterruptGuard interrupt;
    Progress progress(progressStyle(options.quiet, options.json), bake.frames, 0, 1);
    io::ApplyOptions apply;
    apply.output = options.output;
    apply.force = options.force;
    apply.gltf =
        options.gltf == "yes" || (options.gltf == "auto" && !bake.manifest.value("gltf", Json()).is_null());
    apply.gltf_agents = options.gltf_agents;
    apply.identity = layer.text;
    apply.applied = appliedJson(layer, bake);
    apply.go_on = [&](std::uint32_t frames) {
        progress.update(frames, bake.agents, frames);
        return interrupt.signal() == 0;
    };
    const std::optional<io::ApplyResult> result = io::applyOverrides(crowd, changes, apply);
    if (!result) {
        say(stderr, "throng: stopped; nothing was written\n");
        throw Exit(128 + interrupt.signal(), "stopped; nothing was written");
    }
    printResult(options, layer, *result);
}

void run(const Options& options) {
    io::CrowdReader crowd(io::loadBake(options.bake));
    const Layer layer = readLayer(options, crowd);
    const bool missed = options.strict && layer.count(Match::Kind::orphaned) > 0;
    if (options.dry_run) {
        if (options.json)
            sayJson(matchesJson(layer));
        else
            printListing(layer);
    } else {
        tellOrphans(layer);
        if (!missed) write(options, crowd, layer);
    }
    if (!missed) return;
    const std::string why = fmt::format("{} of {} overrides are orphaned (--strict)",
                                        layer.count(Match::Kind::orphaned), layer.matches.size());
    say(stderr, "throng: {}\n", why);
    throw options.dry_run ? Exit(kInvalidInput) : Exit(kInvalidInput, why);
}

}  // namespace

void addApply(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("apply", "Write a bake anew with changes to single people (overrides)");
    auto options = std::make_shared<Options>();
    command->add_option("bake", options->bake, "A bake's folder, or its bake.json")->required();
    command->add_option("--overrides", options->file,
                        "The changes; by default BAKE.overrides.json beside the bake");
    CLI::Option* output = command->add_option("-o,--output", options->output, "The bake to make");
    command->add_flag("--force", options->force, "Replace an existing bake");
    command->add_flag("--strict", options->strict, "Write nothing when an override finds nobody");
    CLI::Option* dry_run =
        command->add_flag("--dry-run", options->dry_run, "Only tell whom each override finds");
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
        run(*options);
    });
}

}  // namespace throng::cli
