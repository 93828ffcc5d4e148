// SPDX-License-Identifier: Apache-2.0
#include "io/overrides/agent_table_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/files/csv.h"
#include "base/files/input_file.h"
#include "base/numbers.h"

namespace throng::io {

AgentTableEdit::AgentTableEdit(const Bake& bake) : path_(bake.folder / "agents.csv") {
    CsvReader table(readFile(path_, kMostTable));
    table.next(columns_);
    std::vector<std::string> fields;
    while (table.next(fields)) {
        if (fields.size() != columns_.size())
            throw InputError(path_, fmt::format("line {} has {} fields where the heading has {}",
                                                rows_.size() + 2, fields.size(), columns_.size()));
        rows_.push_back(fields);
    }
    if (rows_.size() != bake.agents)
        throw InputError(path_,
                         fmt::format("has {} people where bake.json has {}", rows_.size(), bake.agents));
}

bool AgentTableEdit::has(const std::string& column) const {
    return std::ranges::find(columns_, column) != columns_.end();
}

std::size_t AgentTableEdit::indexOf(const std::string& column) const {
    const auto found = std::ranges::find(columns_, column);
    if (found == columns_.end()) throw InputError(path_, fmt::format("has no column `{}`", column));
    return static_cast<std::size_t>(found - columns_.begin());
}

const std::string& AgentTableEdit::at(std::uint32_t row, const std::string& column) const {
    return rows_.at(row)[indexOf(column)];
}

double AgentTableEdit::number(std::uint32_t row, const std::string& column) const {
    const std::string& field = at(row, column);
    const std::optional<double> value = finiteNumber(field);
    if (!value)
        throw InputError(path_, fmt::format("line {}: `{}` is not a number ({})", row + 2, field, column));
    return *value;
}

std::optional<std::uint32_t> AgentTableEdit::frame(std::uint32_t row, const std::string& column) const {
    if (at(row, column).empty()) return std::nullopt;
    return static_cast<std::uint32_t>(std::clamp(number(row, column), 0.0, 4294967295.0));
}

void AgentTableEdit::addColumn(const std::string& column, const std::string& value) {
    if (has(column)) return;
    columns_.push_back(column);
    for (std::vector<std::string>& row : rows_)
        row.push_back(value);
}

void AgentTableEdit::set(std::uint32_t row, const std::string& column, std::string value) {
    rows_.at(row)[indexOf(column)] = std::move(value);
}

std::uint32_t AgentTableEdit::copyRow(std::uint32_t row) {
    rows_.push_back(std::vector<std::string>(rows_.at(row)));
    const std::uint32_t made = rows() - 1;
    if (has("id")) set(made, "id", std::to_string(made));
    return made;
}

std::string AgentTableEdit::text() const {
    std::string text;
    const auto add = [&](const std::vector<std::string>& fields) {
        for (std::size_t i = 0; i < fields.size(); ++i)
            text += (i ? "," : "") + csvField(fields[i]);
        text += '\n';
    };
    add(columns_);
    for (const std::vector<std::string>& row : rows_)
        add(row);
    return text;
}

std::vector<authoring::Entrant> loadEntrants(const CrowdReader& crowd) {
    const Bake& bake = crowd.bake();
    const AgentTableEdit table(bake);
    const double height = bake.manifest.value("/origin/2"_json_pointer, 0.0);
    std::vector<authoring::Entrant> people(table.rows());
    for (std::uint32_t row = 0; row < table.rows(); ++row) {
        authoring::Entrant& person = people[row];
        person.group = table.at(row, "group");
        const std::optional<std::uint32_t> frame = table.frame(row, "spawn_frame");
        if (!frame || *frame >= bake.frames) continue;
        std::array<float, kComponents> place{};
        crowd.streams()[Stream::pos].readRows(*frame, row, place);
        person.enters = true;
        person.frame = *frame;
        person.place = {bake.origin.x + static_cast<double>(place[0]),
                        bake.origin.y + static_cast<double>(place[1]),
                        height + static_cast<double>(place[2])};
    }
    return people;
}

}  // namespace throng::io
