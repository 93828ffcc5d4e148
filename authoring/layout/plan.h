// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "authoring/behaviour.h"
#include "authoring/layout.h"

/// What stops, goals and events say, written down as what they are: states that lead from one to the next,
/// and to others at a time. It is the table of a layout's `behaviours`, and what is known of these
/// (base/activities.h, how long, what there is to look at) is known of stops. Where nothing but arriving,
/// waiting and a time of the shot leads on, nobody has to ask every step what comes next: such a plan is
/// written down as the stages of a way (Itineraries), and only those with other conditions are played by the
/// device's table (BehaviourTables).
namespace throng::authoring {

/// To go somewhere, and leave there or stay for good.
BehaviourState goalState(const Destination& to, Arrival arrival);

/// Whether an event sends a flow or formation somewhere.
bool sends(const Event& event, const std::string& group_id);

/// A flow's stops, its goal if it has one, and where events send it. In order: `via`, the goal, the events'.
Behaviour planOf(const Layout& layout, const Flow& flow);
/// A formation's goal, where all of it has the same, and where events send it.
Behaviour planOf(const Layout& layout, const Formation& formation);

/// The states that follow each other from one on.
std::vector<BehaviourState> wayFrom(const Behaviour& plan, std::size_t state);

/// At a time of the shot, whatever they do, people begin with another state.
struct Turn {
    double at = 0.0;  ///< s
    std::size_t then = 0;
};
/// In the order of the layout's events.
std::vector<Turn> turnsOf(const Behaviour& plan);

}  // namespace throng::authoring
