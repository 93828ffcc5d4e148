// SPDX-License-Identifier: Apache-2.0
#include "io/agent_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "base/files/csv.h"
#include "base/outcomes.h"

namespace throng::io {
namespace {

std::string_view outcomeName(AgentStatus status) {
    if (status == AgentStatus::walking) return wordFor(Fate::walking);
    if (status == AgentStatus::arrived) return wordFor(Fate::arrived);
    return wordFor(Fate::refused);
}

std::string reasonOf(const AgentOutcome& outcome) {
    if (outcome.status == AgentStatus::waiting) return "the bake was stopped before it could enter";
    if (outcome.status == AgentStatus::refused && outcome.reason.empty())
        return "the bake ended before it could enter";
    return outcome.reason;
}

std::string frameNumber(std::uint32_t frame) {
    return frame == kNone ? std::string() : std::to_string(frame);
}

}  // namespace

AccountTotals countOutcomes(const Account& account) {
    AccountTotals totals;
    totals.agents = static_cast<std::uint32_t>(account.agents.size());
    for (const AgentOutcome& outcome : account.agents) {
        if (outcome.status == AgentStatus::walking) ++totals.walking;
        if (outcome.status == AgentStatus::arrived) ++totals.arrived;
        if (outcome.status != AgentStatus::refused && outcome.status != AgentStatus::waiting) continue;
        ++totals.refused;
        ++totals.refused_reasons[reasonOf(outcome)];
    }
    totals.spawned = totals.walking + totals.arrived;
    return totals;
}

namespace {

const char* kindOf(const recording::BakeGroup& group) {
    if (group.is_given) return "given";
    return group.is_flow ? "flow" : "formation";
}

}  // namespace

std::string agentTable(const recording::BakeDescription& description, const Account& account) {
    if (account.agents.size() != description.agents.size())
        throw std::invalid_argument("the account and the description differ in their number of people");
    const bool has_bodies = std::ranges::any_of(
        description.agents, [](const recording::BakeAgent& agent) { return !agent.body.isDisc(); });
    std::string table =
        "id,group,kind,radius,preferred_speed,variation,party,spawn_frame,arrival_frame,outcome,reason,goal_"
        "x,goal_"
        "y,"
        "distance_walked,shortest_way,profile,look,colours";
    table += has_bodies ? ",breadth,depth\n" : "\n";
    for (std::size_t row = 0; row < description.agents.size(); ++row) {
        const recording::BakeAgent& agent = description.agents[row];
        const recording::BakeGroup& group = description.groups.at(agent.group);
        const AgentOutcome& outcome = account.agents[row];
        fmt::format_to(std::back_inserter(table), "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}",
                       row, csvField(group.id), kindOf(group), agent.radius, agent.preferred_speed,
                       agent.variation, agent.party, frameNumber(outcome.spawn_frame),
                       frameNumber(outcome.arrival_frame), outcomeName(outcome.status),
                       csvField(reasonOf(outcome)), agent.goal.x, agent.goal.y, outcome.distance_walked,
                       outcome.shortest_way, agent.profile, group.look, group.colours);
        if (has_bodies && agent.body.isDisc()) table += ",,";
        if (has_bodies && !agent.body.isDisc())
            fmt::format_to(std::back_inserter(table), ",{:.4g},{:.4g}", agent.body.breadth, agent.body.depth);
        table += '\n';
    }
    return table;
}

}  // namespace throng::io
