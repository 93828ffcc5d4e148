// SPDX-License-Identifier: Apache-2.0
#include "io/agent_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>

#include "base/files/csv.h"
#include "base/files/input_file.h"
#include "base/numbers.h"

namespace throng::io {
namespace {

constexpr std::size_t kFirstLine = 2;  // that has a person
constexpr double kLargest = 1000.0;    // m: radius, of whatever stands for a person

class Columns {
  public:
    Columns(const std::filesystem::path& path, const std::vector<std::string>& names) : path_(path) {
        for (std::size_t i = 0; i < kNames.size(); ++i) {
            const auto found = std::ranges::find(names, kNames[i]);
            if (found == names.end()) throw InputError(path, fmt::format("has no column `{}`", kNames[i]));
            at_[i] = static_cast<std::size_t>(found - names.begin());
        }
        if (const auto found = std::ranges::find(names, "party"); found != names.end())
            party_at_ = static_cast<std::size_t>(found - names.begin());
        if (const auto found = std::ranges::find(names, "kind"); found != names.end())
            kind_at_ = static_cast<std::size_t>(found - names.begin());
        for (std::size_t i = 0; i < kSides.size(); ++i)
            if (const auto found = std::ranges::find(names, kSides[i]); found != names.end())
                side_at_[i] = static_cast<std::size_t>(found - names.begin());
    }
    enum Name {
        group,
        radius,
        preferred_speed,
        spawn_frame,
        arrival_frame,
        outcome,
        goal_x,
        goal_y,
        shortest_way
    };

    AgentRow row(const std::vector<std::string>& fields, std::size_t line, glm::dvec2 origin) const {
        AgentRow result;
        result.group = text(fields, group, line);
        const double size = number(fields, radius, line);
        if (size < 0.0 || size > kLargest)
            throw InputError(path_, fmt::format("line {}: {} m is no radius of a body", line, size));
        result.radius = static_cast<float>(size);
        result.body = {side(fields, 0, line), side(fields, 1, line)};
        if (result.body.isDisc() || result.body.depth <= 0.0) result.body = {};
        result.preferred_speed = static_cast<float>(number(fields, preferred_speed, line));
        result.outcome = text(fields, outcome, line);
        result.shortest_way = number(fields, shortest_way, line);
        result.party = party(fields, line);
        result.is_given = kind_at_ && *kind_at_ < fields.size() && fields[*kind_at_] == "given";
        for (const auto& [name, frame] :
             {std::pair{spawn_frame, &result.spawn_frame}, std::pair{arrival_frame, &result.arrival_frame}})
            if (!text(fields, name, line).empty())
                *frame =
                    static_cast<std::uint32_t>(std::clamp(number(fields, name, line), 0.0, 4294967295.0));
        result.goal = glm::dvec2(number(fields, goal_x, line), number(fields, goal_y, line)) - origin;
        return result;
    }

  private:
    static constexpr std::array kNames = {"group",       "radius",        "preferred_speed",
                                          "spawn_frame", "arrival_frame", "outcome",
                                          "goal_x",      "goal_y",        "shortest_way"};

    static constexpr std::array kSides = {"breadth", "depth"};

    /// m, of a body that is no disc; 0 where there is none.
    double side(const std::vector<std::string>& fields, std::size_t which, std::size_t line) const {
        if (!side_at_[which] || *side_at_[which] >= fields.size() || fields[*side_at_[which]].empty())
            return 0.0;
        const std::optional<double> value = finiteNumber(fields[*side_at_[which]]);
        if (!value || *value < 0.0 || *value > kLargest)
            throw InputError(path_, fmt::format("line {}: `{}` is no `{}` of a body", line,
                                                fields[*side_at_[which]], kSides[which]));
        return *value;
    }

    /// Without that column, everybody is alone.
    std::uint32_t party(const std::vector<std::string>& fields, std::size_t line) const {
        if (!party_at_) return static_cast<std::uint32_t>(line - kFirstLine);
        const std::optional<double> first =
            *party_at_ < fields.size() ? finiteNumber(fields[*party_at_]) : std::nullopt;
        if (!first) throw InputError(path_, fmt::format("line {}: expected a row under `party`", line));
        return static_cast<std::uint32_t>(std::clamp(*first, 0.0, 4294967295.0));
    }

    const std::string& text(const std::vector<std::string>& fields, Name name, std::size_t line) const {
        if (at_[name] >= fields.size())
            throw InputError(path_, fmt::format("line {} is short of fields", line));
        return fields[at_[name]];
    }
    double number(const std::vector<std::string>& fields, Name name, std::size_t line) const {
        const std::string& field = text(fields, name, line);
        const std::optional<double> value = finiteNumber(field);
        if (!value)
            throw InputError(path_,
                             fmt::format("line {}: `{}` is not a number ({})", line, field, kNames[name]));
        return *value;
    }

    const std::filesystem::path& path_;
    std::array<std::size_t, kNames.size()> at_{};
    std::array<std::optional<std::size_t>, 2> side_at_{};  ///< bakes of discs have none
    std::optional<std::size_t> party_at_, kind_at_;
};

}  // namespace

std::vector<AgentRow> loadAgentRows(const Bake& bake) {
    const std::filesystem::path path = bake.folder / "agents.csv";
    CsvReader table(readFile(path, kMostTable));
    std::vector<std::string> fields;
    table.next(fields);
    const Columns columns(path, fields);
    std::vector<AgentRow> rows;
    while (table.next(fields))
        rows.push_back(columns.row(fields, rows.size() + kFirstLine, bake.origin));
    if (rows.size() != bake.agents)
        throw InputError(path, fmt::format("has {} people where bake.json has {}", rows.size(), bake.agents));
    return rows;
}

GroupTable groupsOf(const std::vector<AgentRow>& rows) {
    GroupTable groups;
    std::unordered_map<std::string_view, std::uint32_t> known;
    for (const AgentRow& row : rows) {
        const auto [entry, is_new] = known.try_emplace(row.group, static_cast<std::uint32_t>(known.size()));
        groups.group_of.push_back(entry->second);
        if (is_new) groups.names.push_back(row.group);
    }
    return groups;
}

}  // namespace throng::io
