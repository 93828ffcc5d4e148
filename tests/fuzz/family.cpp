// SPDX-License-Identifier: Apache-2.0
// Families of scenarios: the family, its plan, and the layouts of some of its scenarios.
#include <algorithm>
#include <stdexcept>

#include "authoring/family/family_reader.h"
#include "authoring/layout/layout_reader.h"
#include "support/custom_json.h"
#include "support/small_scene.h"

using namespace throng;

THRONG_FUZZ_JSON(authoring::familySchema(), authoring::layoutSchema())

namespace {

void makeLayout(const authoring::Family& family, const authoring::Scenario& scenario) try {
    const std::string text = authoring::composeLayout(family, scenario).dump(1);
    authoring::Diagnostics diagnostics;
    static_cast<void>(authoring::readLayout(text, {}, diagnostics));
    fuzz::tell(diagnostics, text);
} catch (const std::invalid_argument&) {
    // A value that does not fit is told, scenario by scenario.
}

}  // namespace

void fuzz::readOne(std::string_view input) {
    static const std::filesystem::path base = put("base.json", R"({"throng": 1,
        "areas": [{"id": "a", "polygon": [[0, 0], [9, 0], [9, 9]]}, {"id": "b", "polygon": [[20, 0],
        [29, 0], [29, 9]]}],
        "flows": [{"id": "all", "from": "a", "to": "b", "count": 3}]})");
    authoring::Diagnostics diagnostics;
    const auto family = authoring::readFamily(input, base.parent_path(), diagnostics);
    tell(diagnostics, input);
    constexpr double kMostPlanned = 300.0;
    constexpr std::size_t kMostMade = 6;
    if (!family || authoring::countOf(*family) > kMostPlanned) return;
    const auto scenarios = authoring::planFamily(*family);
    for (std::size_t i = 0; i < std::min(kMostMade, scenarios.size()); ++i)
        makeLayout(*family, scenarios[i * scenarios.size() / std::min(kMostMade, scenarios.size())]);
}
