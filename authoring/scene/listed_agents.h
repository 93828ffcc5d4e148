// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <variant>

#include "authoring/layout.h"

// What formations that list their people say of one of them.
namespace throng::authoring {

/// Null: the formation is no list.
inline const ListedAgent* listed(const Formation& formation, std::uint64_t i) {
    const auto* list = std::get_if<ListFormation>(&formation.shape);
    return list ? &list->agents[i] : nullptr;
}

/// Of somebody who is listed with a place to go to.
inline const Destination* ownDestination(const Formation& formation, std::uint64_t i) {
    const ListedAgent* agent = listed(formation, i);
    return agent && agent->to ? &*agent->to : nullptr;
}

/// s: when somebody comes in.
inline double startOf(const Formation& formation, std::uint64_t i) {
    const ListedAgent* agent = listed(formation, i);
    return agent ? agent->start : formation.start;
}

/// The places on somebody's way.
inline std::span<const Waypoint> wayOf(const Formation& formation, std::uint64_t i) {
    const ListedAgent* agent = listed(formation, i);
    return agent ? std::span<const Waypoint>(agent->via) : std::span<const Waypoint>();
}

}  // namespace throng::authoring
