// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/people_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "authoring/layout/profiles.h"

namespace throng::authoring {
namespace {

constexpr const char* kDistributionHint =
    R"(for example 1.3, {"uniform": [1.0, 1.6]}, {"normal": [1.34, 0.26]} or {"log_normal": [3.4, 0.9]})";

/// The two numbers of a distribution; the second one has limits of its own where it is a deviation.
std::optional<std::array<double, 2>> readPair(ObjectReader& reader, const JsonNode& pair, Limits first,
                                              Limits second, const char* meaning, Diagnostics& diagnostics) {
    if (pair.kind != JsonNode::Kind::array || pair.items.size() != 2) {
        diagnostics.error(pair.where, fmt::format("expected {}", meaning));
        return std::nullopt;
    }
    const auto a = reader.numberOf(pair.items[0], first);
    const auto b = reader.numberOf(pair.items[1], second);
    return a && b ? std::optional(std::array{*a, *b}) : std::nullopt;
}

Distribution readUniform(ObjectReader& reader, const JsonNode& node, Limits limits,
                         const Distribution& standard, Diagnostics& diagnostics) {
    const auto ends = readPair(reader, node, limits, limits, "[minimum, maximum]", diagnostics);
    if (!ends) return standard;
    const auto [least, most] = *ends;
    if (least > most) diagnostics.error(node.where, "the minimum is above the maximum", "swap the two");
    return {Distribution::Kind::uniform, 0.5 * (least + most), 0.0, least, most};
}

/// Unless told, draws lie within three deviations; those of a logarithm may be as large as the limits allow.
Distribution readBell(ObjectReader& reader, const JsonNode& owner, const JsonNode& node, bool logarithm,
                      Limits limits, const Distribution& standard, Diagnostics& diagnostics) {
    const Limits mean_limits = logarithm ? Limits{-20.0, 20.0} : limits;
    const auto shape = readPair(reader, node, mean_limits, {0.0, 100.0},
                                logarithm ? "[mean of the logarithm, standard deviation of the logarithm]"
                                          : "[mean, standard deviation]",
                                diagnostics);
    Distribution result = standard;
    if (shape) {
        const auto [mean, deviation] = *shape;
        result = {logarithm ? Distribution::Kind::log_normal : Distribution::Kind::normal, mean, deviation,
                  limits.least, limits.most};
        if (!logarithm) {
            result.minimum = std::max(limits.least, mean - 3.0 * deviation);
            result.maximum = std::min(limits.most, mean + 3.0 * deviation);
        }
    }
    reader.number("min", limits, result.minimum);
    reader.number("max", limits, result.maximum);
    if (result.minimum > result.maximum)
        diagnostics.error(
            owner.where,
            fmt::format("`min` ({:.6g}) is above `max` ({:.6g})", result.minimum, result.maximum),
            logarithm ? "swap the two" : "what is not written is three deviations from the mean");
    return result;
}

void readProfile(ObjectReader& people_reader, const JsonNode& node, People& people,
                 Diagnostics& diagnostics) {
    std::vector<std::string> names;
    names.reserve(kProfiles.size());
    for (const Profile& profile : kProfiles)
        names.emplace_back(profile.name);
    people.kinds.clear();
    if (node.kind == JsonNode::Kind::object) {
        ObjectReader reader(node, "`profile`", diagnostics);
        for (const Profile& profile : kProfiles) {
            if (!node.find(std::string(profile.name))) continue;
            double weight = 0.0;
            reader.number(std::string(profile.name), {0.0, 1.0e6, true}, weight);
            people.kinds.push_back({weight, profile.settings});
        }
        reader.finish();
        if (people.kinds.empty())
            diagnostics.error(node.where, "`profile` names nobody",
                              R"(for example {"adult": 0.8, "child": 0.2})");
    } else if (const auto chosen = people_reader.choice("profile", names)) {
        people.kinds.push_back({1.0, kProfiles[*chosen].settings});
    }
    if (people.kinds.empty()) people.kinds.emplace_back();
}

/// The weights of groups of n people where their sizes follow a Poisson distribution without zero, as those
/// of pedestrians do (James 1953; Moussaid et al. 2010, figure 1).
std::array<double, kLargestParty> truncatedPoisson(double lambda) {
    std::array<double, kLargestParty> weights{};
    double weight = 1.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        weight *= lambda / static_cast<double>(i + 1);
        weights[i] = weight;
    }
    return weights;
}

void readPartySizes(ObjectReader& people_reader, const JsonNode& node, People& people,
                    Diagnostics& diagnostics) {
    // The two crowds observed by Moussaid et al.: a street on a weekday, and one on a Saturday.
    const std::vector<std::string> names = {"alone", "weekday", "leisure"};
    if (node.kind != JsonNode::Kind::array) {
        if (const auto chosen = people_reader.choice("groups", names); chosen && *chosen > 0)
            people.party_sizes = truncatedPoisson(*chosen == 1 ? 0.83 : 1.11);
        return;
    }
    people.party_sizes = {};
    if (node.items.empty() || node.items.size() > kLargestParty)
        diagnostics.error(
            node.where,
            fmt::format("expected one to {} weights: of people who walk alone, in twos, ...", kLargestParty),
            "for example [0.4, 0.4, 0.15, 0.05], or \"leisure\"");
    for (std::size_t i = 0; i < std::min(node.items.size(), kLargestParty); ++i)
        people.party_sizes[i] = people_reader.numberOf(node.items[i], {0.0, 1.0e6}).value_or(0.0);
    if (std::accumulate(people.party_sizes.begin(), people.party_sizes.end(), 0.0) > 0.0) return;
    if (!diagnostics.hasErrors()) diagnostics.error(node.where, "all weights are zero");
    people.party_sizes = {1.0};
}

}  // namespace

Distribution readDistribution(ObjectReader& owner, const std::string& key, Limits limits,
                              const Distribution& standard, Diagnostics& diagnostics) {
    const JsonNode* node = owner.get(key);
    if (!node) return standard;
    if (node->kind == JsonNode::Kind::number) {
        const double value = owner.numberOf(*node, limits).value_or(standard.mean);
        return {Distribution::Kind::constant, value, 0.0, value, value};
    }
    if (node->kind != JsonNode::Kind::object) {
        diagnostics.error(node->where,
                          fmt::format("expected a number or a distribution, found {}", node->kindName()),
                          kDistributionHint);
        return standard;
    }
    ObjectReader reader(*node, "a distribution", diagnostics);
    const JsonNode* uniform = reader.get("uniform");
    const JsonNode* normal = reader.get("normal");
    const JsonNode* log_normal = reader.get("log_normal");
    Distribution result = standard;
    if ((uniform != nullptr) + (normal != nullptr) + (log_normal != nullptr) != 1)
        diagnostics.error(node->where,
                          "a distribution needs exactly one of `uniform`, `normal` and `log_normal`",
                          kDistributionHint);
    else if (uniform)
        result = readUniform(reader, *uniform, limits, standard, diagnostics);
    else
        result = readBell(reader, *node, normal ? *normal : *log_normal, log_normal != nullptr, limits,
                          standard, diagnostics);
    reader.finish();
    return result;
}

People readPeople(ObjectReader& owner, Diagnostics& diagnostics) {
    People people;
    const JsonNode* node = owner.get("people");
    if (!node) return people;
    ObjectReader reader(*node, "`people`", diagnostics);
    if (const JsonNode* profile = reader.get("profile")) readProfile(reader, *profile, people, diagnostics);
    if (const JsonNode* sizes = reader.get("groups")) readPartySizes(reader, *sizes, people, diagnostics);
    PersonSettings common;
    common.speed = readDistribution(reader, "speed", {0.05, 10.0}, common.speed, diagnostics);
    common.radius = readDistribution(reader, "radius", {0.1, 1.0}, common.radius, diagnostics);
    common.reaction = readDistribution(reader, "reaction", {0.0, 3600.0}, common.reaction, diagnostics);
    reader.number("maximum_speed_factor", {1.0, 3.0}, common.maximum_speed_factor);
    reader.number("headway", {0.0, 5.0}, common.headway);
    reader.finish();
    for (PeopleShare& share : people.kinds) {
        if (node->find("speed")) share.settings.speed = common.speed;
        if (node->find("radius")) share.settings.radius = common.radius;
        if (node->find("reaction")) share.settings.reaction = common.reaction;
        share.settings.maximum_speed_factor = common.maximum_speed_factor;
        share.settings.headway = common.headway;
    }
    return people;
}

}  // namespace throng::authoring
