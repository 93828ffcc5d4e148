// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "authoring/layout/layout_reader.h"
#include "authoring/scene/audience.h"
#include "authoring/storeys/charts.h"
#include "base/files/input_file.h"
#include "base/numbers.h"
#include "base/streams.h"
#include "cli/baking/bake_description.h"
#include "cli/baking/load_layout.h"
#include "cli/batch/check_family.h"
#include "cli/commands.h"
#include "cli/terminal/exit_codes.h"
#include "cli/terminal/failure.h"
#include "cli/terminal/say.h"
#include "io/room_on_disk.h"
#include "sim/memory.h"

namespace throng::cli {
namespace {

struct CheckOptions {
    std::vector<std::string> layouts;
    std::vector<std::string> overrides;
    bool json = false;
};

/// With those who have seats.
std::size_t peopleIn(const LoadedLayout& loaded) {
    return loaded.scene.people.size() + authoring::audienceOf(loaded.layout).size();
}

/// Those of blocks that people walk to or leave are among the scene's.
std::size_t groupsIn(const LoadedLayout& loaded) {
    const auto closed =
        std::ranges::count_if(loaded.layout.seats, [](const auto& block) { return !block.isOpen(); });
    return loaded.scene.groups.size() + static_cast<std::size_t>(closed);
}

/// Of the streams that every bake of it has, in the forms that are written unless told.
std::uint64_t bytesOfBake(const LoadedLayout& loaded) {
    const StreamChoice streams = streamsOf(loaded.scene.terrain != nullptr, {});
    return io::bytesOfStreams(countOf(streams), StreamFormats::standard(), framesOf(loaded.scene.settings),
                              peopleIn(loaded));
}

/// m^2
double areaOf(const authoring::Surface& surface) {
    const auto spots =
        std::ranges::count_if(surface.spots, [](std::uint32_t spot) { return spot != authoring::kNoSpot; });
    return static_cast<double>(spots) * authoring::kChartCell * authoring::kChartCell;
}

/// The names of those that a ground of a terrain goes on to.
std::vector<std::string> joinedTo(const authoring::Charts& charts, std::size_t chart) {
    std::vector<std::string> names;
    for (std::size_t other = 0; other < charts.charts.size(); ++other)
        if (other != chart && charts.rasters[chart].isJoinedTo(other))
            names.push_back(charts.charts[other].name);
    return names;
}

nlohmann::ordered_json groundsJson(const authoring::Charts& charts) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < charts.charts.size(); ++i)
        list.push_back({{"id", charts.charts[i].name},
                        {"area", areaOf(*charts.charts[i].surface)},
                        {"joined_to", joinedTo(charts, i)}});
    return list;
}

/// What a terrain with faces above each other was cut into.
void printGrounds(const LoadedLayout& loaded) {
    if (!loaded.scene.charts || !loaded.scene.charts->grounds) return;
    const authoring::Charts& charts = *loaded.scene.charts;
    say(stdout, "{}: terrain `{}`: {} grounds of one height at a place each\n", loaded.diagnostics.file,
        loaded.layout.terrain->file, charts.charts.size());
    for (std::size_t i = 0; i < charts.charts.size(); ++i) {
        const std::vector<std::string> joined = joinedTo(charts, i);
        say(stdout, "  {}: {:.1f} m^2, {}\n", charts.charts[i].name, areaOf(*charts.charts[i].surface),
            joined.empty() ? "joined to none" : fmt::format("joined to {}", fmt::join(joined, ", ")));
    }
    const authoring::TerrainFindings& findings = charts.grounds->findings;
    for (const authoring::TerrainFindings::Piece& piece : findings.unreached)
        say(stdout, "  nobody gets to {:.1f} m^2 round ({:.2f}, {:.2f}, {:.2f})\n", piece.area, piece.at.x,
            piece.at.y, piece.at.z);
    if (findings.unreached_count > findings.unreached.size())
        say(stdout, "  nor to {} smaller ones\n", findings.unreached_count - findings.unreached.size());
}

/// What is too large for one bake is a mistake of the layout like others.
/// @returns bytes of the device's memory
std::uint64_t tellMemory(LoadAttempt& attempt) try {
    return attempt.valid ? sim::memoryNeeded(attempt.loaded.scene).all() : 0;
} catch (const std::runtime_error& error) {
    attempt.loaded.diagnostics.error({}, error.what());
    attempt.valid = false;
    return 0;
}

nlohmann::ordered_json toJson(const LoadAttempt& attempt, std::uint64_t device_bytes) {
    nlohmann::ordered_json result = {{"file", attempt.loaded.diagnostics.file}, {"valid", attempt.valid}};
    if (attempt.valid) {
        result["agents"] = peopleIn(attempt.loaded);
        result["stream_bytes"] = bytesOfBake(attempt.loaded);
        result["device_bytes"] = device_bytes;
        if (const auto& charts = attempt.loaded.scene.charts; charts && charts->grounds)
            result["grounds"] = groundsJson(*charts);
    }
    result["diagnostics"] = diagnosticsJson(attempt.loaded.diagnostics);
    return result;
}

/// @returns whether it is valid
bool checkFamilyFile(const std::string& path, const CheckOptions& options, nlohmann::ordered_json& list) {
    if (!options.overrides.empty())
        throw CLI::ValidationError("--set", fmt::format("changes layouts; `{}` is a family of them", path));
    FamilyCheck check;
    nlohmann::ordered_json wrong = nlohmann::ordered_json::array();
    try {
        check = checkFamily(path);
    } catch (const Exit& exit) {
        check.diagnostics.file = path;
        wrong = exit.diagnostics;
    }
    if (options.json) {
        nlohmann::ordered_json result = {{"file", path},
                                         {"valid", check.valid},
                                         {"scenarios", check.scenarios},
                                         {"layouts_read", check.layouts_read},
                                         {"scenes_built", check.scenes_built}};
        result["diagnostics"] = wrong.empty() ? diagnosticsJson(check.diagnostics) : wrong;
        list.push_back(std::move(result));
        return check.valid;
    }
    for (const authoring::Diagnostic& entry : check.diagnostics.entries)
        say(stderr, "{}\n", authoring::formatDiagnostic(entry, path, ""));
    if (check.valid)
        say(stdout, "{}: ok: {} scenarios of `{}`; {} layouts were read and {} scenes made of them\n", path,
            check.scenarios, check.base_name, check.layouts_read, check.scenes_built);
    return check.valid;
}

void printSummary(const LoadedLayout& loaded, std::uint64_t device_bytes) {
    const authoring::Scene& scene = loaded.scene;
    say(stdout,
        "{}: ok: {} people in {} groups, {} wall segments, {:.0f} x {:.0f} m, {:.4g} s at {:.4g} frames/s; "
        "it needs {} of the device's memory, and its streams will take {}\n",
        loaded.diagnostics.file, peopleIn(loaded), groupsIn(loaded), scene.wall_segments.size(),
        scene.maximum.x - scene.minimum.x, scene.maximum.y - scene.minimum.y, scene.settings.duration,
        scene.settings.fps, readableBytes(device_bytes), readableBytes(bytesOfBake(loaded)));
}

bool checkLayoutText(const std::string& path, std::string text, const CheckOptions& options,
                     nlohmann::ordered_json& list) {
    LoadAttempt attempt =
        tryReadLayout(std::move(text), path == "-" ? "standard input" : path, options.overrides);
    const std::uint64_t device_bytes = tellMemory(attempt);
    if (options.json) {
        list.push_back(toJson(attempt, device_bytes));
        return attempt.valid;
    }
    printDiagnostics(attempt.loaded);
    if (attempt.valid) printSummary(attempt.loaded, device_bytes);
    if (attempt.valid) printGrounds(attempt.loaded);
    return attempt.valid;
}

void runCheck(const CheckOptions& options) {
    bool all_valid = true;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const std::string& path : options.layouts) {
        std::string text = path == "-" ? readStandardInput() : readFile(path);
        const bool valid = path != "-" && isFamily(text)
                               ? checkFamilyFile(path, options, list)
                               : checkLayoutText(path, std::move(text), options, list);
        all_valid = all_valid && valid;
    }
    if (options.json) sayJson(list);
    if (!all_valid) throw Exit(kInvalidInput);
}

}  // namespace

void addCheck(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "check", "Say everything that is wrong with layouts and families of them, without baking them");
    auto options = std::make_shared<CheckOptions>();
    command
        ->add_option("layout", options->layouts,
                     "Files of layouts or families (- for a layout on standard input)")
        ->required();
    command
        ->add_option("--set", options->overrides,
                     "Override a value, e.g. --set simulation.seed=7 (repeatable)")
        ->take_all()
        ->expected(1);
    command->add_flag("--json", options->json, "Print a JSON document");
    command->footer("Example:\n  throng check examples/*.json");
    command->callback([options] { runCheck(*options); });
}

}  // namespace throng::cli
