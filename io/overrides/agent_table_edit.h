// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "authoring/overrides/matching.h"
#include "io/crowd_reader.h"

namespace throng::io {

/// A bake's agents.csv as text, to be changed in some places: columns that this program knows nothing of
/// stay.
class AgentTableEdit {
  public:
    /// Throws InputError when the table is not one of this bake's people.
    explicit AgentTableEdit(const Bake& bake);

    std::uint32_t rows() const { return static_cast<std::uint32_t>(rows_.size()); }
    bool has(const std::string& column) const;
    /// Throws InputError when there is no such column.
    const std::string& at(std::uint32_t row, const std::string& column) const;
    double number(std::uint32_t row, const std::string& column) const;
    /// A frame number; nothing where the field is empty.
    std::optional<std::uint32_t> frame(std::uint32_t row, const std::string& column) const;

    void addColumn(const std::string& column, const std::string& value);
    void set(std::uint32_t row, const std::string& column, std::string value);
    /// Another line like this, with an id of its own, at the end. @returns its row
    std::uint32_t copyRow(std::uint32_t row);
    std::string text() const;

  private:
    std::size_t indexOf(const std::string& column) const;

    std::filesystem::path path_;
    std::vector<std::string> columns_;
    std::vector<std::vector<std::string>> rows_;
};

/// Where and when everybody of a bake enters: what overrides are matched with. Reads agents.csv and single
/// rows of the stream `pos`.
std::vector<authoring::Entrant> loadEntrants(const CrowdReader& crowd);

}  // namespace throng::io
