// SPDX-License-Identifier: Apache-2.0
// Changes to single people, matched with those of a bake and applied to it.
#include "authoring/overrides/matching.h"
#include "authoring/overrides/overrides_reader.h"
#include "io/overrides/agent_table_edit.h"
#include "io/overrides/apply_layers.h"
#include "io/overrides/apply_overrides.h"
#include "support/custom_json.h"
#include "support/small_scene.h"
#include "tests/io/sample_crowd.h"

using namespace throng;

THRONG_FUZZ_JSON(authoring::overridesSchema())

namespace {

constexpr std::uint32_t kMostPeople = 100;

std::filesystem::path sampleBake() {
    test::SampleOptions options;
    options.rows = 6;
    options.frames = 8;
    return test::SampleCrowd(options).bake(fuzz::folder() / "bake").path;
}

}  // namespace

void fuzz::readOne(std::string_view input) {
    static const std::filesystem::path bake = sampleBake();
    authoring::Diagnostics diagnostics;
    const auto overrides = authoring::readOverrides(input, diagnostics);
    tell(diagnostics, input);
    if (!overrides) return;
    io::CrowdReader crowd(io::loadBake(bake));
    const std::vector<authoring::Entrant> people = io::loadEntrants(crowd);
    const std::vector<authoring::Match> matches = authoring::matchOverrides(overrides->people, people);
    std::vector<io::RowChange> changes;
    for (std::size_t i = 0; i < matches.size(); ++i)
        if (matches[i].kind == authoring::Match::Kind::orphaned)
            static_cast<void>(authoring::orphanReason(overrides->people[i], people));
        else if (!overrides->people[i].change.changesNothing())
            changes.push_back({matches[i].row, overrides->people[i].change});
    io::LayeredCrowd layered(crowd);
    io::changeRows(layered, changes);
    try {
        static_cast<void>(io::applyLayers(layered, overrides->layers, people, kMostPeople));
    } catch (const InputError&) {  // too many copies
        return;
    }
    if (changes.empty() && overrides->layers.empty()) return;
    io::ApplyOptions options;
    options.output = folder() / "applied";
    options.force = true;
    options.gltf = true;
    options.watch_overlaps = true;
    static_cast<void>(io::writeApplied(layered, options));
}
