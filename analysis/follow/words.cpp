// SPDX-License-Identifier: Apache-2.0
// The account of somebody who was followed, as text and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/follow/account.h"
#include "base/numbers.h"

namespace throng::analysis {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kWorthTelling = 0.02;  // of all
constexpr std::size_t kMostTold = 6;

std::string words(const std::vector<RuleShare>& shares) {
    std::string text;
    for (std::size_t i = 0; i < std::min(shares.size(), kMostTold); ++i) {
        if (shares[i].share < kWorthTelling) break;
        text +=
            fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", shares[i].rule, 100.0 * shares[i].share);
    }
    return text.empty() ? "nothing" : text;
}

Json json(const std::vector<RuleShare>& shares) {
    Json object = Json::object();
    for (const RuleShare& share : shares)
        object[share.rule] = readable(share.share);
    return object;
}

Json json(const std::optional<Spell>& spell) {
    if (!spell) return nullptr;
    return {{"from", readable(spell->from)},
            {"to", readable(spell->to)},
            {"place", {readable(spell->place.x), readable(spell->place.y)}},
            {"causes", json(spell->causes)}};
}

std::string words(const Spell& spell) {
    return fmt::format("{:.2f} s from {:.2f} s on at ({:.2f}, {:.2f}): {}", spell.to - spell.from, spell.from,
                       spell.place.x, spell.place.y, words(spell.causes));
}

std::string percent(double part, double whole) {
    return fmt::format("{:.1f} %", whole > 0.0 ? 100.0 * part / whole : 0.0);
}

}  // namespace

nlohmann::ordered_json followJson(const FollowAccount& a) {
    return {{"row", a.row},
            {"steps", a.steps},
            {"decisions", a.decisions},
            {"from", readable(a.from)},
            {"to", readable(a.to)},
            {"walked", readable(a.walked)},
            {"under_way_seconds", readable(a.under_way)},
            {"wished_speed", readable(a.wished_speed)},
            {"had_speed", readable(a.had_speed)},
            {"held_back", json(a.held_back)},
            {"standing_seconds", readable(a.standing)},
            {"longest_standstill", json(a.longest_standstill)},
            {"astray_seconds", readable(a.astray)},
            {"astray", json(a.astray_causes)},
            {"moving_seconds", readable(a.moving)},
            {"backward_seconds", readable(a.backward)},
            {"backward_by_wish_seconds", readable(a.backward_by_wish)},
            {"backward_spells", a.backward_spells},
            {"longest_backward", json(a.longest_backward)},
            {"backward", json(a.backward_causes)}};
}

std::string followText(const FollowAccount& a) {
    std::string text = fmt::format("row {}: {:.2f} s to {:.2f} s, {} steps, {} decisions, {:.1f} m walked\n",
                                   a.row, a.from, a.to, a.steps, a.decisions, a.walked);
    text += fmt::format("  under way   {:.2f} s, wished {:.2f} m/s, had {:.2f} m/s along that\n", a.under_way,
                        a.wished_speed, a.had_speed);
    text += fmt::format("  held back   {}\n", words(a.held_back));
    text += fmt::format("  standing    {:.2f} s of {:.2f} s under way\n", a.standing, a.under_way);
    if (a.longest_standstill) text += fmt::format("    longest   {}\n", words(*a.longest_standstill));
    text += fmt::format("  astray      {:.2f} s ({} of the time under way)", a.astray,
                        percent(a.astray, a.under_way));
    text += a.astray > 0.0 ? fmt::format(": {}\n", words(a.astray_causes)) : "\n";
    text += fmt::format("  backward    {:.2f} s in {} spells ({} of the time it moved)\n", a.backward,
                        a.backward_spells, percent(a.backward, a.moving));
    if (a.backward > 0.0) {
        text += fmt::format("    by        {}\n", words(a.backward_causes));
        text += fmt::format("    wished so {:.2f} s: its wish was behind it, too\n", a.backward_by_wish);
        text += fmt::format("    longest   {}\n", words(*a.longest_backward));
    }
    return text;
}

}  // namespace throng::analysis
