// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "authoring/layout.h"
#include "authoring/layout/object_reader.h"
#include "authoring/layout/place_reader.h"
#include "authoring/layout/traffic_reader.h"

namespace throng::authoring {

/// Reads behaviours: tables of what people do, and what leads them from one thing to the next.
class BehaviourReader {
  public:
    /// @param groups ids of flows and formations, known once these are read; @param walls likewise, of walls
    BehaviourReader(const Schema& schema, Layout& layout, const PlaceReader& places, const Indices& groups,
                    const Indices& walls, const TrafficReader& traffic, Diagnostics& diagnostics)
        : schema_(schema),
          layout_(layout),
          places_(places),
          groups_(groups),
          walls_(walls),
          traffic_(traffic),
          diagnostics_(diagnostics) {}

    void read(const JsonNode& node);
    /// The behaviour of a flow or formation. @param instead keys that say what the behaviour says
    std::optional<std::size_t> behaviourOf(ObjectReader& reader, const JsonNode& owner,
                                           const std::vector<std::string>& instead) const;
    /// What people do whose goal is {"seats": ...}: as a behaviour. @returns nothing where it is none
    std::optional<std::size_t> sittingIn(const JsonNode& goal, const std::string& owner);
    /// What is said of somebody who has a behaviour, and only that says it.
    void refuseBeside(const JsonNode& owner, const std::vector<std::string>& keys) const;
    /// After all else: the flows, formations and gates that behaviours speak of, and what leads where.
    void finish();

  private:
    using State = BehaviourState;
    using Does = BehaviourState::Does;
    void readState(const JsonNode& node, SchemaRule rule, State& state);
    std::optional<Does> activityOf(ObjectReader& reader, const JsonNode& node, const JsonNode*& what);
    void readActivity(ObjectReader& reader, const JsonNode& what, State& state);
    void readVisits(ObjectReader& reader, const JsonNode& what, State& state);
    void readSeats(const JsonNode& what, std::vector<GroupName>& blocks);
    void readQueue(ObjectReader& reader, const JsonNode& what, State& state);
    void readFlight(ObjectReader& reader, const JsonNode& what, State& state);
    void readFollowing(ObjectReader& reader, const JsonNode& what, State& state);
    static void checkSeatsOf(const Behaviour& behaviour, Diagnostics& diagnostics);
    void readPose(ObjectReader& reader, State& state);
    void readManner(ObjectReader& reader, State& state);
    void readExits(ObjectReader& reader, const JsonNode& node, State& state);
    static Condition* addCondition(ObjectReader& reader, const char* key, Condition::Kind kind,
                                   Transition& transition);
    void checkIsTrue(const JsonNode& node, const char* key);
    void readNearness(ObjectReader& reader, const JsonNode& node, Transition& transition);
    void readCounts(ObjectReader& reader, const JsonNode& node, Transition& transition);
    void readGates(ObjectReader& reader, const JsonNode& node, Transition& transition);
    void readLights(ObjectReader& reader, const JsonNode& node, Transition& transition);
    void readTransition(const JsonNode& node, SchemaRule rule, State& state);
    void readPlaceOrPeople(const JsonNode& node, Condition& condition);
    void readWho(const JsonNode& list, Condition& condition);
    void checkKeys(const JsonNode& node, const State& state);
    std::optional<std::size_t> stateNamed(const JsonNode& node);
    void checkGroup(const GroupName& name, bool or_place);
    void checkLight(const Condition& condition);
    void checkGate(const Condition& condition);
    void checkReferences(const Behaviour& behaviour);

    const Schema& schema_;
    Layout& layout_;
    const PlaceReader& places_;
    const Indices& groups_;
    const Indices& walls_;
    const TrafficReader& traffic_;
    Diagnostics& diagnostics_;
    Indices behaviours_;
    Indices states_;  // of the behaviour at hand
};

}  // namespace throng::authoring
