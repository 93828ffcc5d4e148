// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/draw_people.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "authoring/layout/layout_reader.h"
#include "authoring/layout/plan.h"
#include "authoring/scene/audience.h"
#include "authoring/scene/boarding.h"
#include "authoring/scene/given.h"
#include "authoring/scene/listed_agents.h"
#include "authoring/scene/people.h"
#include "authoring/scene/placed_bodies.h"
#include "authoring/scene/traffic.h"
#include "base/side_by_side.h"

namespace throng::authoring {
namespace {

constexpr double kComesOutByVehicle = 1.0e9;  // s: at a time of its own nobody gets off

bool goAlike(const ListedAgent& a, const ListedAgent& b) {
    const auto same = [](const Place& one, const Place& other) {
        return one.kind == other.kind && one.index == other.index;
    };
    const auto placesOf = [](const ListedAgent& agent) {
        return agent.to ? std::span<const Place>(agent.to->places) : std::span<const Place>();
    };
    return a.start == b.start && a.wait == b.wait && std::ranges::equal(placesOf(a), placesOf(b), same) &&
           std::ranges::equal(a.via, b.via, {}, &Waypoint::point, &Waypoint::point) &&
           std::ranges::equal(a.via, b.via, {}, &Waypoint::wait, &Waypoint::wait);
}

void overrideListed(const ListedAgent& agent, gpu::Person& person) {
    if (agent.radius) {
        person.radius = static_cast<float>(*agent.radius);
        person.half_axis = 0.0f;
    }
    if (!agent.speed) return;
    person.maximum_speed *= static_cast<float>(*agent.speed) / person.preferred_speed;
    person.preferred_speed = static_cast<float>(*agent.speed);
}

class PeopleDrawer {
  public:
    PeopleDrawer(const Layout& layout, const Rebase& rebase, Scene& scene)
        : layout_(layout), rebase_(rebase), scene_(scene) {}

    float drawEverybody() {
        for (std::size_t i = 0; i < layout_.flows.size(); ++i)
            drawFlow(layout_.flows[i], i);
        for (const Formation& formation : layout_.formations)
            drawFormation(formation);
        for (std::size_t block = 0; block < layout_.seats.size(); ++block)
            if (layout_.seats[block].isOpen()) drawAudience(block);
        for (std::size_t index = 0; index < layout_.given.size(); ++index) {
            beginGroup(layout_.given[index].id, false, layout_.given[index].people);
            scene_.groups.back().is_given = true;
            for (gpu::Person& person : givenPeople(layout_, index, scene_.charts.get(), rebase_, group())) {
                person.party_first = static_cast<std::uint32_t>(scene_.people.size());
                addPerson(person);
            }
        }
        return thinnest_;
    }

  private:
    /// So many more people; thousands of small groups are still not moved about for each.
    void expect(std::size_t count) {
        std::vector<gpu::Person>& people = scene_.people;
        if (people.size() + count > people.capacity())
            people.reserve(std::max(people.size() + count, 2 * people.capacity()));
    }

    void drawFlow(const Flow& flow, std::size_t index) {
        const GroupRandom random(layout_.simulation.seed, flow.id);
        std::vector<RateChange> changes;
        for (const Event& event : layout_.events)
            if (event.kind == Event::Kind::rate && event.subject == index)
                changes.push_back({event.at, event.rate});
        // Who is told to go elsewhere does not come in any more.
        double end = std::numeric_limits<double>::infinity();
        for (const Turn& turn : turnsOf(planOf(layout_, flow)))
            if (turn.at > flow.start) end = std::min(end, turn.at);
        const std::vector<double> times =
            flow.alights ? std::vector<double>(alightingPeople(layout_, flow), kComesOutByVehicle)
                         : entryTimes(flow, changes, random, layout_.simulation.warmup, end);
        beginGroup(flow.id, true, flow.people);
        expect(times.size());
        std::vector<Party> parties = drawParties(flow.people, random, times.size());
        if (flow.alights) {
            const std::uint64_t each = std::max<std::uint64_t>(flow.count.value_or(0), 1);
            parties = splitWhere(parties, [&](std::uint64_t i) { return i % each == 0; });
        }
        for (const Party& party : parties) {
            for (std::uint64_t i = party.first; i < party.first + party.size; ++i) {
                gpu::Person person = drawPerson(flow.people, random, i, group());
                person.spawn_time = static_cast<float>(times[party.first]);
                if (flow.alights) person.flags |= gpu::PERSON_ALIGHTS;
                if (keepsToRoads(layout_)) person.flags |= gpu::PERSON_KEEPS_TO_ROADS;
                addPerson(person);
            }
            bringTogether(party, scene_.people.size() - party.size);
        }
    }

    void drawFormation(const Formation& formation) {
        const GroupRandom random(layout_.simulation.seed, formation.id);
        const FormationPlaces places = formationPlaces(formation, layout_.simulation.seed);
        const auto* list = std::get_if<ListFormation>(&formation.shape);
        beginGroup(formation.id, false, formation.people);
        expect(places.positions.size());
        std::vector<Party> parties = drawParties(formation.people, random, places.positions);
        if (list)  // nobody waits for company that comes later or goes another way
            parties = splitWhere(
                parties, [&](std::uint64_t i) { return !goAlike(list->agents[i - 1], list->agents[i]); });
        const std::size_t first = scene_.people.size();
        scene_.people.resize(first + places.positions.size());
        doSideBySide(places.positions.size(), kPeopleWorthAThread, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                gpu::Person& person = scene_.people[first + i];
                person = drawPerson(formation.people, random, i, group());
                if (list) overrideListed(list->agents[i], person);
                person.own_radius = person.radius;
                person.spawn_position = rebase_.local(places.positions[i]);
                const double start = startOf(formation, i);
                person.spawn_time = static_cast<float>(start == 0.0 ? -layout_.simulation.warmup : start);
                person.flags |= gpu::PERSON_FIXED_SPAWN;
            }
        });
        for (std::size_t row = first; row < scene_.people.size(); ++row)
            count(scene_.people[row], row == 0);
        for (const Party& party : parties)
            bringTogether(party, first + party.first);
    }

    /// Those who sit in a block that people walk to or leave.
    void drawAudience(std::size_t index) {
        const SeatBlock& block = layout_.seats[index];
        beginGroup(block.id, false, block.people);
        scene_.groups.back().block = index;
        const std::vector<Spectator> audience = audienceIn(layout_, index);
        for (std::size_t i = 0; i < audience.size(); ++i) {
            const Spectator& each = audience[i];
            gpu::Person person = each.person;
            person.group = group();
            person.spawn_position = rebase_.local(each.seat.place);
            person.spawn_time = static_cast<float>(-layout_.simulation.warmup);
            person.heading = static_cast<float>(std::atan2(each.seat.ahead.y, each.seat.ahead.x));
            person.flags |=
                gpu::PERSON_FIXED_SPAWN | gpu::PERSON_PRESENT_AT_START | gpu::PERSON_SITS_AT_START;
            addPerson(person);
            const bool is_last = i + 1 == audience.size() || audience[i + 1].party != each.party;
            const auto size = static_cast<std::uint32_t>(i + 1 - each.party);
            if (is_last) bringTogether({each.party, size}, scene_.people.size() - size);
        }
    }

    void bringTogether(const Party& party, std::size_t first_row) {
        const std::span members = std::span(scene_.people).subspan(first_row, party.size);
        for (gpu::Person& person : members) {
            person.party_first = static_cast<std::uint32_t>(first_row);
            person.party_size = party.size;
        }
        walkTogether(members);
    }

    void beginGroup(const std::string& id, bool is_flow, const People& people) {
        scene_.groups.push_back({id, is_flow, false, people.look, people.colours, {}});
        for (const PeopleShare& share : people.kinds)
            scene_.groups.back().profiles.push_back(share.profile);
        scene_.queues.push_back({static_cast<gpu::uint>(scene_.people.size()), 0});
    }
    std::uint32_t group() const { return static_cast<std::uint32_t>(scene_.groups.size() - 1); }
    void addPerson(const gpu::Person& person) {
        count(person, scene_.people.empty());
        scene_.people.push_back(person);
        scene_.people.back().own_radius = person.radius;
    }
    void count(const gpu::Person& person, bool first) {
        scene_.smallest_radius = first ? person.radius : std::min(scene_.smallest_radius, person.radius);
        scene_.largest_radius = first ? person.radius : std::max(scene_.largest_radius, person.radius);
        thinnest_ = first ? thicknessOf(person) : std::min(thinnest_, thicknessOf(person));
        ++scene_.queues.back().row_count;
    }

    const Layout& layout_;
    const Rebase& rebase_;
    Scene& scene_;
    float thinnest_ = 0.0f;
};

}  // namespace

float drawEverybody(const Layout& layout, const Rebase& rebase, Scene& scene) {
    return PeopleDrawer(layout, rebase, scene).drawEverybody();
}

}  // namespace throng::authoring
