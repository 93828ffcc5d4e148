// SPDX-License-Identifier: Apache-2.0
#include "cli/baking/load_layout.h"

#include <fmt/format.h>

#include <filesystem>
#include <span>

#include "authoring/layout/layout_reader.h"
#include "authoring/scene/scene_builder.h"
#include "authoring/scene/seat_ground.h"
#include "base/files/errors.h"
#include "base/files/hash.h"
#include "base/files/input_file.h"
#include "cli/baking/given_files.h"
#include "cli/terminal/exit_codes.h"
#include "cli/terminal/failure.h"
#include "cli/terminal/say.h"
#include "io/gltf/terrain_file.h"

namespace throng::cli {
namespace {

/// A terrain that cannot be used is a mistake in the layout, told where the layout names it.
void readTerrain(const std::string& name, LoadedLayout& loaded) {
    const authoring::TerrainSettings& settings = *loaded.layout.terrain;
    const std::filesystem::path path = std::filesystem::path(name).parent_path() / settings.file;
    try {
        loaded.terrain = std::make_shared<const authoring::TerrainMesh>(io::readTerrain(path, settings));
        Hasher hasher;
        hasher.add(std::as_bytes(std::span(loaded.terrain->positions)));
        hasher.add(std::as_bytes(std::span(loaded.terrain->indices)));
        loaded.terrain_hash = hashFile(path).xxh3;
        loaded.terrain_identity = hasher.digest();
    } catch (const InputError& error) {
        const bool named = std::string_view(error.what()).find("named") != std::string_view::npos;
        loaded.diagnostics.error(named ? settings.node_where : settings.file_where,
                                 fmt::format("the terrain cannot be used: {}", error.what()),
                                 named ? "`node` is the name of a node or a mesh in the file"
                                       : "`file` is a .glb or .gltf file, relative to the layout's folder");
    }
}

}  // namespace

LoadAttempt tryReadLayout(std::string text, const std::string& name, std::vector<std::string> overrides,
                          authoring::GroundCache* cache, const SolverMaker& make_solver) {
    LoadAttempt attempt;
    LoadedLayout& loaded = attempt.loaded;
    loaded.text = std::move(text);
    loaded.overrides = std::move(overrides);
    loaded.diagnostics.file = name;
    std::optional<authoring::Layout> layout =
        authoring::readLayout(loaded.text, loaded.overrides, loaded.diagnostics);
    if (!layout) return attempt;
    loaded.layout = std::move(*layout);
    if (loaded.layout.terrain) readTerrain(name, loaded);
    loaded.given_identity = readGivenFiles(name, loaded.layout, loaded.diagnostics);
    if (loaded.diagnostics.hasErrors()) return attempt;
    if (loaded.terrain) authoring::layOnTerrain(loaded.layout, *loaded.terrain, loaded.diagnostics);
    if (loaded.diagnostics.hasErrors()) return attempt;
    const auto solver = make_solver ? make_solver() : nullptr;
    loaded.fields_on_device = solver != nullptr;
    std::optional<authoring::Scene> scene =
        authoring::buildScene(loaded.layout, loaded.diagnostics, cache, loaded.terrain.get(), solver.get());
    if (!scene) return attempt;
    loaded.scene = std::move(*scene);
    if (loaded.layout.name.empty()) loaded.layout.name = std::filesystem::path(name).stem().string();
    attempt.valid = true;
    return attempt;
}

LoadAttempt tryLoadLayout(const std::string& path, const std::vector<std::string>& overrides,
                          const SolverMaker& make_solver) {
    const bool is_file = path != "-";
    LoadAttempt attempt = tryReadLayout(is_file ? readFile(path) : readStandardInput(),
                                        is_file ? path : "standard input", overrides, nullptr, make_solver);
    if (is_file) attempt.loaded.file = std::filesystem::path(path).filename().string();
    return attempt;
}

void printDiagnostics(const LoadedLayout& loaded) {
    for (const authoring::Diagnostic& entry : loaded.diagnostics.entries)
        say(stderr, "{}\n", authoring::formatDiagnostic(entry, loaded.diagnostics.file, loaded.text));
    if (loaded.diagnostics.left_out > 0)
        say(stderr, "{}: {} more of the kind\n", loaded.diagnostics.file, loaded.diagnostics.left_out);
}

LoadedLayout loadLayout(const std::string& path, const std::vector<std::string>& overrides,
                        const SolverMaker& make_solver) {
    LoadAttempt attempt = tryLoadLayout(path, overrides, make_solver);
    printDiagnostics(attempt.loaded);
    if (!attempt.valid)
        throw Exit(kInvalidInput, "the layout is not valid", diagnosticsJson(attempt.loaded.diagnostics));
    return std::move(attempt.loaded);
}

}  // namespace throng::cli
