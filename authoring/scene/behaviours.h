// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/scene.h"
#include "authoring/scene/itineraries.h"
#include "authoring/scene/rebase.h"
#include "authoring/scene/routes.h"
#include "authoring/scene/traffic.h"

namespace throng::authoring {

/// Turns behaviours into the tables that the device reads. Each flow and formation has its own copy of its
/// behaviour: fields for its people, spots with room for its bodies, and "everybody" is its own.
class BehaviourTables {
  public:
    BehaviourTables(const Layout& layout, const Rebase& rebase, const WalkGeometry& geometry, Routes& routes,
                    Itineraries& itineraries, Diagnostics& diagnostics, Scene& scene);

    /// Whose behaviour it is.
    struct Owner {
        std::string name;       ///< "flow `id`", for messages
        std::size_t group = 0;  ///< index into the scene's groups
        bool keep_to_roads = false;
        std::string start;               ///< where its people begin, for messages
        std::vector<LocalPolygon> from;  ///< the same, as outlines
    };
    /// Appends the states of a behaviour. @returns the one in which people begin
    std::uint32_t add(const Behaviour& behaviour, const Owner& owner);
    /// Two stages that a row has for its own, and an empty mind that is in a state.
    void begin(gpu::Person& person, std::size_t row, std::uint32_t state);
    /// The field that leads to the first place of a state, or NO_INDEX; and its middle.
    std::uint32_t fieldOf(std::uint32_t state) const;

    /// Calls want(destination, keep_to_roads) for whatever behaviours lead to.
    template <class Want>
    static void destinations(const Layout& layout, Want want);
    /// The places of a state as destinations of their own, each of which has a field.
    static std::vector<Destination> destinationsOf(const BehaviourState& state);

  private:
    struct Outline {
        std::uint32_t first = 0, count = 0;
    };
    Outline outlineOf(const Place& place);
    gpu::BehaviourPlace placeOf(const Destination& to, const Place& place, const Owner& owner, bool spots);
    void addPlaces(const BehaviourState& state, const Owner& owner, gpu::BehaviourState& result);
    void addRules(const BehaviourState& state, const Owner& owner, std::uint32_t first_state,
                  gpu::BehaviourState& result);
    std::vector<gpu::BehaviourRule> rulesOf(const Condition& condition, const Owner& owner);
    void fillRule(const Condition& condition, const Owner& owner, gpu::BehaviourRule& rule);
    void addLine(const BehaviourState& state, const Owner& owner, gpu::BehaviourState& result);
    LightPlan lightOf(const Condition& condition) const;
    std::uint32_t censusOf(const Place& place, gpu::SpawnQueue rows);
    void spotsFor(gpu::BehaviourPlace& place, const LocalPolygon& outline, const Owner& owner);
    void checkWay(const Destination& to, const Place& place, std::uint32_t field, const Owner& owner);
    gpu::SpawnQueue rowsOf(const std::string& group) const;

    const Layout& layout_;
    const Rebase& rebase_;
    const WalkGeometry& geometry_;
    Routes& routes_;
    Itineraries& itineraries_;
    Diagnostics& diagnostics_;
    Scene& scene_;
    std::map<std::string, Outline> outlines_;  // by place
};

template <class Want>
void BehaviourTables::destinations(const Layout& layout, Want want) {
    const auto wantAll = [&](const std::optional<std::size_t>& behaviour, bool keep_to_roads) {
        if (!behaviour) return;
        for (const BehaviourState& state : layout.behaviours[*behaviour].states)
            for (const Destination& to : destinationsOf(state))
                want(to, keep_to_roads);
    };
    for (const Flow& flow : layout.flows)
        wantAll(flow.behaviour, keepsToRoads(layout));
    for (const Formation& formation : layout.formations)
        wantAll(formation.behaviour, false);
    for (const SeatBlock& block : layout.seats)
        wantAll(block.behaviour, false);
}

}  // namespace throng::authoring
