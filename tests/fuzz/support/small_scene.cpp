// SPDX-License-Identifier: Apache-2.0
#include "small_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "authoring/layout/layout_reader.h"
#include "authoring/scene/rebase.h"
#include "authoring/scene/scene_builder.h"
#include "harness.h"

namespace throng::fuzz {
namespace {

constexpr double kMostPeople = 500.0;
constexpr double kWidest = 120.0;  // m

double peopleOf(const authoring::Layout& layout) {
    double people = 0.0;
    for (const authoring::Flow& flow : layout.flows)
        people += flow.count ? static_cast<double>(*flow.count)
                             : flow.rate.value_or(0.0) *
                                   std::max(0.0, flow.end - flow.start + layout.simulation.warmup);
    for (const authoring::Formation& formation : layout.formations) {
        if (const auto* circle = std::get_if<authoring::CircleFormation>(&formation.shape))
            people += static_cast<double>(circle->count);
        else if (const auto* grid = std::get_if<authoring::GridFormation>(&formation.shape))
            people += static_cast<double>(grid->rows) * static_cast<double>(grid->columns);
    }
    return people;
}

}  // namespace

void buildIfSmall(const authoring::Layout& layout, authoring::Diagnostics& diagnostics,
                  const authoring::TerrainMesh* terrain) {
    if (peopleOf(layout) > kMostPeople || authoring::Rebase(layout).extent() > kWidest) return;
    static_cast<void>(authoring::buildScene(layout, diagnostics, nullptr, terrain));
}

void tell(const authoring::Diagnostics& diagnostics, std::string_view text) {
    constexpr std::size_t kLongest = 4000;
    for (const authoring::Diagnostic& entry : diagnostics.entries)
        if (const std::string told = authoring::formatDiagnostic(entry, "input.json", text);
            told.size() > kLongest)
            finding(fmt::format("a message of {} letters", told.size()));
}

}  // namespace throng::fuzz
