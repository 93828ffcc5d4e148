// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/people.h"

#include <cmath>

namespace throng::authoring {
namespace {

constexpr double kStride =
    1.4;  // m per gait cycle: what the cast's walk is made for, so that its feet do not slide
constexpr double kBriskest = 1.0e7;  // more people than this from one rate is a mistake

}  // namespace

const PersonSettings& kindOf(const People& people, const GroupRandom& random, std::uint64_t index) {
    double left = 0.0;
    for (const PeopleShare& share : people.kinds)
        left += share.weight;
    left *= random.unit(index, Purpose::kind);
    for (const PeopleShare& share : people.kinds) {
        if (left < share.weight) return share.settings;
        left -= share.weight;
    }
    return people.kinds.back().settings;
}

gpu::Person drawPerson(const People& people, const GroupRandom& random, std::uint64_t index,
                       std::uint32_t group) {
    const PersonSettings& settings = kindOf(people, random, index);
    gpu::Person person{};
    const double speed = random.draw(settings.speed, index, Purpose::speed);
    person.radius = static_cast<float>(random.draw(settings.radius, index, Purpose::radius));
    person.preferred_speed = static_cast<float>(speed);
    person.maximum_speed = static_cast<float>(speed * settings.maximum_speed_factor);
    person.headway = static_cast<float>(settings.headway);
    person.stride_length = static_cast<float>(kStride);
    person.phase = static_cast<float>(random.unit(index, Purpose::phase));
    person.variation = static_cast<std::uint32_t>(random.word(index, Purpose::variation) % kVariations);
    person.entry = gpu::NO_INDEX;
    person.group = group;
    return person;
}

std::vector<double> entryTimes(const Flow& flow, const GroupRandom& random, double warmup) {
    // Those of the first moment have the warm-up to come in.
    const double start = flow.start == 0.0 ? -warmup : flow.start;
    std::vector<double> times;
    if (flow.count) {
        const double slot = (flow.end - start) / static_cast<double>(*flow.count);
        for (std::uint64_t i = 0; i < *flow.count; ++i)
            times.push_back(start + (static_cast<double>(i) + random.unit(i, Purpose::time)) * slot);
    } else if (flow.rate) {
        double time = start;
        for (std::uint64_t i = 0; static_cast<double>(i) < kBriskest; ++i) {
            time -= std::log(1.0 - random.unit(i, Purpose::time)) / *flow.rate;
            if (time >= flow.end) break;
            times.push_back(time);
        }
    }
    return times;
}

}  // namespace throng::authoring
