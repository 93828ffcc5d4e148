// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/capsule.h"
#include "io/bake_reader.h"

namespace throng::io {

/// One line of agents.csv.
struct AgentRow {
    std::string group;
    float radius = 0.0f;                        ///< m
    BodySize body;                              ///< where it is no disc
    float preferred_speed = 0.0f;               ///< m/s
    std::uint32_t party = 0;                    ///< row of the first of those it walks with; its own: alone
    std::uint32_t spawn_frame = 0xffffffffu;    ///< from 0; all bits set: never
    std::uint32_t arrival_frame = 0xffffffffu;  ///< likewise
    std::string outcome;                        ///< walking, arrived or refused
    bool is_given = false;                      ///< follows a given way
    double shortest_way = 0.0;                  ///< m, round walls
    glm::dvec2 goal{0.0};                       ///< m, in the frame of the streams

    /// m, of the disc that holds all of it
    double reach() const { return body.isDisc() ? static_cast<double>(radius) : body.radius(); }
};

/// Reads agents.csv. Throws InputError, with the line, when a field is missing or not what it should be.
std::vector<AgentRow> loadAgentRows(const Bake& bake);

/// Which group each row belongs to.
struct GroupTable {
    std::vector<std::string> names;       ///< in the order in which they first appear
    std::vector<std::uint32_t> group_of;  ///< per row, index into names
};
GroupTable groupsOf(const std::vector<AgentRow>& rows);

}  // namespace throng::io
