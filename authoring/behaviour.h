// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "authoring/destination.h"
#include "authoring/distribution.h"
#include "authoring/source_position.h"
#include "authoring/traffic.h"
#include "base/activities.h"

/// What people do, state by state, and what leads them from one to the next.
namespace throng::authoring {

/// The name of a flow or formation, before all are known.
struct GroupName {
    std::string id;
    SourcePosition where;
};

/// One thing that has to hold.
struct Condition {
    enum class Kind {
        after,        ///< so long in the state
        at,           ///< this time of the shot has come
        arrived,      ///< stands at its place, or its way is done
        near_place,   ///< no further from it
        near_people,  ///< no further from one of a flow or formation
        crowded,      ///< more people around
        chance,       ///< so large a share per second
        empty,        ///< nobody else is in an area
        all_here,     ///< everybody of the own flow or formation is in an area
        open,         ///< a gate
        closed,       ///< a gate
        green,        ///< a crossing or lane, by its signal
        red,          ///< likewise
    };
    Kind kind = Kind::arrived;
    Distribution time;     ///< s; after, at
    double number = 0.0;   ///< m; persons/m^2; share
    Place place;           ///< near_place, empty, all_here: an area or the end of a road
    std::size_t wall = 0;  ///< open, closed
    Lit light;             ///< green, red
    std::vector<GroupName> who;
    SourcePosition where;
};

/// Where several conditions stand together, all have to hold.
struct Transition {
    std::vector<Condition> conditions;
    std::size_t then = 0;  ///< index into the behaviour's states
};

/// What somebody does for a while. A stop on a flow's way is one, too, and so is where an event sends people.
struct BehaviourState {
    enum class Does { walk, stay, wander, visit, gather, flee, follow, queue, sit };
    std::string id;
    Does does = Does::stay;
    Destination to;  ///< walk, gather, queue; wander: one area; visit: its places
    std::uint64_t least = 1, most = 1;
    std::optional<Distribution> lasts;  ///< s at each place; queue: that one is served
    std::vector<glm::dvec2> line;       ///< queue: where people line up, from the front
    double spacing = 0.8;               ///< queue: m between people in line
    ActivityCode activity = ActivityCode::stands;
    std::optional<glm::dvec2> facing;
    glm::dvec2 from{0.0};  ///< flee
    double distance = 0.0;
    GroupName followed;  ///< follow, flee: of these the nearest; flee: no id where it is from a point
    std::vector<GroupName> blocks;        ///< sit: of seats; in any of them
    std::optional<std::uint64_t> person;  ///< follow: of the formation or flow, from 0
    double pace = 1.0;
    bool for_good = false;
    std::vector<Transition> until;
    std::optional<std::size_t> then;
    SourcePosition where;
    /// Whether people stay there at all, or pass through.
    bool stops() const { return lasts && (lasts->kind != Distribution::Kind::constant || lasts->mean > 0.0); }
};

struct Behaviour {
    std::string id;
    std::vector<BehaviourState> states;
    std::size_t start = 0;
    SourcePosition where;
};

}  // namespace throng::authoring
