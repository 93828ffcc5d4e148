// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "authoring/layout.h"

/// Changes to single people of a bake, kept in a file of their own so that a bake made again keeps them.
/// Metres, world coordinates, degrees counter-clockwise, frames from 0.
namespace throng::authoring {

/// What somebody's colours are to be.
struct Tint {
    std::string text;                          ///< as agents.csv has it: "#a01020", or three numbers
    std::array<double, 3> draws{};             ///< 0 to 1: what the cast picks its colours by
    std::optional<std::uint32_t> colour = {};  ///< 0xRRGGBB, sRGB: instead of `draws`
};

/// What is changed about one person. As it stands here it changes nothing.
struct PersonChange {
    bool hide = false;
    std::optional<std::uint32_t> character;  ///< the variation to appear as
    std::optional<Tint> tint;
    std::optional<double> scale;  ///< of the whole figure
    glm::dvec3 move{0.0};         ///< m
    double turn = 0.0;            ///< degrees about the place of entry
    double delay = 0.0;           ///< frames; earlier below zero
    double speed = 1.0;           ///< of its time, from its entry on
    std::string hero;             ///< stands elsewhere as this hero, and so not in the crowd

    bool hides() const { return hide || !hero.empty(); }
    bool moves() const { return move != glm::dvec3(0.0) || turn != 0.0; }
    bool retimes() const { return delay != 0.0 || speed != 1.0; }
    bool changesNothing() const {
        return !hides() && !character && !tint && !scale && !moves() && !retimes();
    }
};

/// One person's changes, and by what the person is known in whatever bake.
struct Override {
    SourcePosition where;
    std::uint32_t id = 0;
    std::string group;
    std::uint32_t spawn_frame = 0;
    glm::dvec3 spawn_place{0.0};
    PersonChange change;
};

/// "hide", "move", ...: what an override changes, in words.
inline std::vector<std::string> changeWords(const PersonChange& change) {
    std::vector<std::string> words;
    if (change.hide) words.emplace_back("hide");
    if (change.character) words.emplace_back("character");
    if (change.tint) words.emplace_back("tint");
    if (change.scale) words.emplace_back("scale");
    if (change.moves()) words.emplace_back("move");
    if (change.retimes()) words.emplace_back("retime");
    if (!change.hero.empty()) words.emplace_back("hero");
    return words;
}

}  // namespace throng::authoring
