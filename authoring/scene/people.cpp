// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/people.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/capsule.h"

namespace throng::authoring {
namespace {

/// m/s that a group is slower for each further member (Moussaid et al. 2010, figure 2, the quieter crowd).
constexpr float kSlowerPerMember = 0.04f;
constexpr double kBriskest = 1.0e7;  // more people than this from one rate is a mistake

}  // namespace

std::uint32_t kindOf(const People& people, const GroupRandom& random, std::uint64_t index) {
    double left = 0.0;
    for (const PeopleShare& share : people.kinds)
        left += share.weight;
    left *= random.unit(index, Purpose::kind);
    for (std::uint32_t kind = 0; kind < people.kinds.size(); ++kind) {
        if (left < people.kinds[kind].weight) return kind;
        left -= people.kinds[kind].weight;
    }
    return static_cast<std::uint32_t>(people.kinds.size() - 1);
}

gpu::Person drawPerson(const People& people, const GroupRandom& random, std::uint64_t index,
                       std::uint32_t group) {
    gpu::Person person{};
    person.kind = kindOf(people, random, index);
    const PersonSettings& settings = people.kinds[person.kind].settings;
    const double speed = random.draw(settings.speed, index, Purpose::speed);
    person.radius = static_cast<float>(random.draw(settings.radius, index, Purpose::radius));
    if (settings.body) {
        const BodySize size{random.draw(settings.body->breadth, index, Purpose::breadth),
                            random.draw(settings.body->depth, index, Purpose::depth)};
        person.radius = static_cast<float>(size.radius());
        person.half_axis = static_cast<float>(size.halfAxis());
    }
    person.preferred_speed = static_cast<float>(speed);
    person.maximum_speed = static_cast<float>(speed * settings.maximum_speed_factor);
    person.headway = static_cast<float>(settings.headway);
    person.phase = static_cast<float>(random.unit(index, Purpose::phase));
    person.variation = static_cast<std::uint32_t>(random.word(index, Purpose::variation) % kVariations);
    person.entry = gpu::NO_INDEX;
    person.party_size = 1;
    person.group = group;
    return person;
}

std::vector<Party> drawParties(const People& people, const GroupRandom& random, std::uint64_t count) {
    double all = 0.0;
    for (const double weight : people.party_sizes)
        all += weight;
    std::vector<Party> parties;
    for (std::uint64_t i = 0; i < count; i += parties.back().size) {
        double left = all * random.unit(i, Purpose::party);
        std::uint32_t size = 1;
        while (size < people.party_sizes.size() && left >= people.party_sizes[size - 1])
            left -= people.party_sizes[size++ - 1];
        parties.push_back({i, static_cast<std::uint32_t>(std::min<std::uint64_t>(size, count - i))});
    }
    return parties;
}

std::vector<Party> drawParties(const People& people, const GroupRandom& random,
                               const std::vector<glm::dvec2>& positions) {
    std::vector<Party> result;
    const double apart = positions.size() > 1 ? 1.8 * glm::distance(positions[0], positions[1]) : 0.0;
    for (const Party& party : drawParties(people, random, positions.size()))
        for (std::uint64_t i = party.first; i < party.first + party.size; ++i)
            if (i == party.first || glm::distance(positions[i], positions[i - 1]) > apart)
                result.push_back({i, 1});
            else
                ++result.back().size;
    return result;
}

std::vector<Party> splitWhere(const std::vector<Party>& parties,
                              const std::function<bool(std::uint64_t)>& begins) {
    std::vector<Party> split;
    for (const Party& party : parties)
        for (std::uint64_t i = party.first; i < party.first + party.size; ++i)
            if (i == party.first || begins(i))
                split.push_back({i, 1});
            else
                ++split.back().size;
    return split;
}

void walkTogether(std::span<gpu::Person> party) {
    if (party.size() < 2) return;
    float mean = 0.0f;
    for (const gpu::Person& person : party)
        mean += person.preferred_speed / static_cast<float>(party.size());
    const float speed = std::max(mean - kSlowerPerMember * static_cast<float>(party.size() - 1), 0.3f * mean);
    for (gpu::Person& person : party) {
        person.maximum_speed = std::max(person.maximum_speed, 1.2f * speed);
        person.preferred_speed = speed;
    }
}

std::vector<double> entryTimes(const Flow& flow, const std::vector<RateChange>& changes,
                               const GroupRandom& random, double warmup, double end) {
    // Those of the first moment have the warm-up to come in.
    const double start = flow.start == 0.0 ? -warmup : flow.start;
    std::vector<double> times;
    if (flow.count) {
        const double slot = (flow.end - start) / static_cast<double>(*flow.count);
        for (std::uint64_t i = 0; i < *flow.count; ++i)
            times.push_back(start + (static_cast<double>(i) + random.unit(i, Purpose::time)) * slot);
        std::erase_if(times, [&](double time) { return time >= end; });
    } else if (flow.rate) {
        // Whatever is left of a waiting time at a change passes at the new rate.
        double time = start, rate = *flow.rate;
        auto change = changes.begin();
        for (std::uint64_t i = 0; static_cast<double>(i) < kBriskest; ++i) {
            double waiting = -std::log(1.0 - random.unit(i, Purpose::time));
            for (; change != changes.end() && time + waiting / rate >= change->time; ++change) {
                waiting -= std::max(change->time - time, 0.0) * rate;
                time = std::max(time, change->time);
                rate = change->rate;
            }
            time += waiting / rate;
            if (!(time < std::min(flow.end, end))) break;
            times.push_back(time);
        }
    } else if (flow.gaps) {
        double time = start;
        for (std::uint64_t i = 0; static_cast<double>(i) < kBriskest; ++i) {
            time += std::max(random.draw(*flow.gaps, i, Purpose::time), kLeastGap);
            if (!(time < std::min(flow.end, end))) break;
            times.push_back(time);
        }
    } else {
        for (const double time : flow.times)
            if (time >= -warmup && time < end) times.push_back(time);
    }
    return times;
}

}  // namespace throng::authoring
