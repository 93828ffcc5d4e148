// SPDX-License-Identifier: Apache-2.0
#include "authoring/cli/load_layout.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "authoring/cli/exit_codes.h"
#include "authoring/layout/layout_reader.h"
#include "authoring/scene/scene_builder.h"
#include "io/files/errors.h"

namespace throng::cli {
namespace {

std::string readText(const std::string& path) {
    std::ostringstream text;
    if (path == "-") {
        text << std::cin.rdbuf();
        return text.str();
    }
    if (std::filesystem::is_directory(path))
        throw io::InputError(path, "is a folder; a layout file was expected");
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw io::InputError(path, fmt::format("cannot be read: {}", std::strerror(errno)));
    text << stream.rdbuf();
    return text.str();
}

}  // namespace

LoadAttempt tryReadLayout(std::string text, const std::string& name, std::vector<std::string> overrides,
                          authoring::GroundCache* cache) {
    LoadAttempt attempt;
    LoadedLayout& loaded = attempt.loaded;
    loaded.text = std::move(text);
    loaded.overrides = std::move(overrides);
    loaded.diagnostics.file = name;
    std::optional<authoring::Layout> layout =
        authoring::readLayout(loaded.text, loaded.overrides, loaded.diagnostics);
    if (!layout) return attempt;
    loaded.layout = std::move(*layout);
    std::optional<authoring::Scene> scene = authoring::buildScene(loaded.layout, loaded.diagnostics, cache);
    if (!scene) return attempt;
    loaded.scene = std::move(*scene);
    if (loaded.layout.name.empty()) loaded.layout.name = std::filesystem::path(name).stem().string();
    attempt.valid = true;
    return attempt;
}

LoadAttempt tryLoadLayout(const std::string& path, const std::vector<std::string>& overrides) {
    return tryReadLayout(readText(path), path == "-" ? "standard input" : path, overrides);
}

void printDiagnostics(const LoadedLayout& loaded) {
    for (const authoring::Diagnostic& entry : loaded.diagnostics.entries)
        fmt::print(stderr, "{}\n", authoring::formatDiagnostic(entry, loaded.diagnostics.file, loaded.text));
}

LoadedLayout loadLayout(const std::string& path, const std::vector<std::string>& overrides) {
    LoadAttempt attempt = tryLoadLayout(path, overrides);
    printDiagnostics(attempt.loaded);
    if (!attempt.valid) throw Exit(kInvalidInput);
    return std::move(attempt.loaded);
}

}  // namespace throng::cli
