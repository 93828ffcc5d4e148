// SPDX-License-Identifier: Apache-2.0
#include "io/under_way.h"

#include <cmath>
#include <utility>

#include "io/manifest.h"

namespace throng::io {
namespace {

using Json = nlohmann::ordered_json;
constexpr const char* kPeople = "people";
constexpr double kWidest = 10.0;  // m, of a body

Json manifestOf(const recording::BakeDescription& description) {
    BakeOutcome outcome;
    outcome.frames = description.frames;
    outcome.account.agents = static_cast<std::uint32_t>(description.agents.size());
    return bakeManifest(description, outcome);
}

std::vector<AgentRow> peopleOf(const recording::BakeDescription& description) {
    std::vector<AgentRow> people;
    people.reserve(description.agents.size());
    for (const recording::BakeAgent& agent : description.agents) {
        AgentRow& row = people.emplace_back();
        row.group = description.groups.at(agent.group).id;
        row.radius = agent.radius;
        row.body = agent.body;
        row.preferred_speed = agent.preferred_speed;
    }
    return people;
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
    throw InputError(path, "/people: expected " + what);
}

std::vector<AgentRow> readPeople(const std::filesystem::path& path, const Json& json, std::uint32_t count) {
    const auto list = [&](const char* key) -> const Json& {
        if (!json.is_object() || !json.contains(key) || !json[key].is_array())
            fail(path, std::string("a list `") + key + "`");
        return json[key];
    };
    const Json &groups = list("groups"), &group = list("group"), &radius = list("radius");
    if (group.size() != count || radius.size() != count) fail(path, "as many people as `agents` says");
    std::vector<AgentRow> people(count);
    for (std::uint32_t row = 0; row < count; ++row) {
        if (!group[row].is_number_unsigned() || group[row].get<std::uint64_t>() >= groups.size())
            fail(path, "numbers of groups that there are");
        const Json& name = groups[group[row].get<std::size_t>()];
        if (!name.is_string()) fail(path, "names of groups");
        if (!radius[row].is_number() || !(std::abs(radius[row].get<double>()) <= kWidest))
            fail(path, "sizes of people");
        people[row].group = name.get<std::string>();
        people[row].radius = radius[row].get<float>();
    }
    return people;
}

}  // namespace

ExpectedBake expectedBake(const recording::BakeDescription& description) {
    // As its text says it: numbers are of other kinds in what has just been made.
    const std::string text = manifestOf(description).dump(-1, ' ', false, Json::error_handler_t::replace);
    return {bakeOf({description.output / "bake.json", {}, Json::parse(text)}), peopleOf(description)};
}

std::string underWayText(const recording::BakeDescription& description) {
    Json json = manifestOf(description);
    Json& people =
        json[kPeople] = {{"groups", Json::array()}, {"group", Json::array()}, {"radius", Json::array()}};
    for (const recording::BakeGroup& group : description.groups)
        people["groups"].push_back(group.id);
    for (const recording::BakeAgent& agent : description.agents) {
        people["group"].push_back(agent.group);
        people["radius"].push_back(agent.radius);
    }
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

ExpectedBake readUnderWay(const std::filesystem::path& folder) {
    ManifestFile file = readManifest(folder / kUnderWayFile);
    const std::filesystem::path path = file.path;
    const Json people = file.json.value(kPeople, Json());
    ExpectedBake expected{bakeOf(std::move(file)), {}};
    expected.people = readPeople(path, people, expected.bake.agents);
    return expected;
}

}  // namespace throng::io
