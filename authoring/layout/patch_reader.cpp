// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/patch_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "authoring/layout/polygon_check.h"

namespace throng::authoring {

void PatchReader::read(const JsonNode& node) {
    Patch patch;
    patch.where = node.where;
    ObjectReader reader(node, schema_.definition("patch"), "a patch", diagnostics_);
    if (!reader.isObject()) return;
    reader.text("id", patch.id);
    patch.polygon = reader.points("polygon");
    patch.level = levels_.levelOf(reader);
    std::optional<double> cost;
    reader.number("cost", cost);
    reader.number("pace", patch.pace);
    reader.number("size", patch.size);
    // Where people are slow, a way round that takes no longer is as good.
    patch.cost = cost.value_or(std::max(1.0, 1.0 / patch.pace));
    reader.number("from", patch.from);
    reader.number("until", patch.until);
    reader.finish();
    checkPolygon(patch.polygon, node.find("polygon"), diagnostics_);
    check(node, patch);
    if (patch.id.empty()) patch.id = fmt::format("patch{}", layout_.patches.size());
    claimId(node, patch.id, patches_, layout_.patches.size(), "a patch", diagnostics_);
    layout_.patches.push_back(std::move(patch));
}

void PatchReader::check(const JsonNode& node, const Patch& patch) const {
    if (!node.find("cost") && !node.find("pace") && !node.find("size"))
        diagnostics_.error(node.where,
                           "a patch says neither `cost` nor `pace` nor `size`: it would change nothing",
                           R"(for example "cost": 3, "pace": 0.6, or "size": 1.3)");
    if (patch.until && *patch.until <= patch.from)
        diagnostics_.error(node.find("until")->where, "the patch ends before it begins, or when it does",
                           "`until` is a time of the shot, as `from` is");
    const bool heeds =
        layout_.simulation.avoid_congestion && layout_.simulation.motion.isOn("routes_round_jams");
    if (patch.isForATime() && patch.cost > 1.0 && !heeds)
        diagnostics_.error(node.where,
                           "what is avoided for a time needs routes that change, and these are switched off",
                           "leave out simulation.avoid_congestion, or the patch's `from` and `until`, or "
                           "give it \"cost\": 1");
}

}  // namespace throng::authoring
