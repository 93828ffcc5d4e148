// SPDX-License-Identifier: Apache-2.0
// What `--set` takes, a line each, over a layout that has every kind of object.
#include <sstream>
#include <string>
#include <vector>

#include "authoring/layout/layout_reader.h"
#include "base/files/input_file.h"
#include "support/harness.h"
#include "support/small_scene.h"

using namespace throng;

void fuzz::readOne(std::string_view input) {
    static const std::string base = readFile(THRONG_FUZZ_LAYOUT);
    std::istringstream lines{std::string(input)};
    std::vector<std::string> settings;
    constexpr std::size_t kMost = 20;
    for (std::string line; settings.size() < kMost && std::getline(lines, line);)
        settings.push_back(line);
    authoring::Diagnostics diagnostics;
    static_cast<void>(authoring::readLayout(base, settings, diagnostics));
    tell(diagnostics, base);
}
