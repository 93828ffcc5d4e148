// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

#include "authoring/layout/layout_reader.h"
#include "authoring/scene/scene_builder.h"

namespace throng::test {

/// The scene of a layout without mistakes; it may have warnings.
inline authoring::Scene sceneOfLayout(const std::string& text) {
    authoring::Diagnostics diagnostics;
    const auto layout = authoring::readLayout(text, {}, diagnostics);
    std::optional<authoring::Scene> scene;
    if (layout) scene = authoring::buildScene(*layout, diagnostics);
    for (const authoring::Diagnostic& entry : diagnostics.entries)
        if (entry.severity == authoring::Severity::error) ADD_FAILURE() << entry.message;
    return scene.value();
}

/// The scene of one of the project's examples.
inline authoring::Scene sceneOfExample(const std::string& name) {
    std::ifstream file(std::filesystem::path(THRONG_EXAMPLES) / (name + ".json"));
    std::stringstream text;
    text << file.rdbuf();
    return sceneOfLayout(text.str());
}

}  // namespace throng::test
