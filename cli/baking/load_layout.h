// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/scene.h"
#include "authoring/scene/ground.h"

namespace throng::cli {

/// A layout file, read, checked and made into a scene.
struct LoadedLayout {
    std::string text;  ///< the file, byte for byte
    std::string file;  ///< its name, without folders; empty where it was none
    std::vector<std::string> overrides;
    authoring::Layout layout;
    std::shared_ptr<const authoring::TerrainMesh> terrain;  ///< null: flat ground
    std::string terrain_hash;                               ///< of the terrain's file
    std::uint64_t terrain_identity = 0;                     ///< of all that was read of it
    std::uint64_t given_identity = 0;                       ///< of all given ways that files tell; 0: none
    authoring::Scene scene;
    bool fields_on_device = false;       ///< where distance fields were solved
    authoring::Diagnostics diagnostics;  ///< warnings
};

/// What came of trying: `valid` or a list of errors.
struct LoadAttempt {
    LoadedLayout loaded;
    bool valid = false;
};

/// Makes what solves distance fields, once a layout is known to be one; null: the CPU.
using SolverMaker = std::function<std::unique_ptr<authoring::DistanceSolver>()>;

/// Makes the scene of a layout's text.
/// @param name of the file, for messages, for the layout if it has none of its own, and to find its terrain
/// beside it
/// @param cache as buildScene
LoadAttempt tryReadLayout(std::string text, const std::string& name, std::vector<std::string> overrides,
                          authoring::GroundCache* cache = nullptr, const SolverMaker& make_solver = {});

/// Reads a layout ("-" is standard input) and builds its scene.
/// @throws InputError when the file cannot be read at all
LoadAttempt tryLoadLayout(const std::string& path, const std::vector<std::string>& overrides,
                          const SolverMaker& make_solver = {});

/// The same, printing what is wrong to stderr.
/// @throws Exit with kInvalidInput when there are errors
LoadedLayout loadLayout(const std::string& path, const std::vector<std::string>& overrides,
                        const SolverMaker& make_solver = {});

/// Prints all diagnostics to stderr.
void printDiagnostics(const LoadedLayout& loaded);

}  // namespace throng::cli
