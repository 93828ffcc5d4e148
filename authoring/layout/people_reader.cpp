// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/people_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace throng::authoring {
namespace {

constexpr const char* kDistributionHint =
    R"(for example 1.3, {"uniform": [1.0, 1.6]}, {"normal": [1.34, 0.26]} or {"log_normal": [3.4, 0.9]})";

/// The two numbers of a distribution; the second one has limits of its own where it is a deviation.
std::optional<std::array<double, 2>> readPair(const JsonNode& pair, Limits first, Limits second,
                                              const char* meaning, Diagnostics& diagnostics) {
    if (pair.kind != JsonNode::Kind::array || pair.items.size() != 2) {
        diagnostics.error(pair.where, fmt::format("expected {}", meaning));
        return std::nullopt;
    }
    const auto a = numberOf(pair.items[0], first, diagnostics);
    const auto b = numberOf(pair.items[1], second, diagnostics);
    return a && b ? std::optional(std::array{*a, *b}) : std::nullopt;
}

Distribution readUniform(ObjectReader& reader, const JsonNode& node, const Distribution& standard,
                         Diagnostics& diagnostics) {
    const SchemaRule rule = reader.rule("uniform");
    const auto ends =
        readPair(node, rule.item().limits(), rule.item().limits(), "[minimum, maximum]", diagnostics);
    if (!ends) return standard;
    const auto [least, most] = *ends;
    if (least > most) diagnostics.error(node.where, "the minimum is above the maximum", "swap the two");
    return {Distribution::Kind::uniform, 0.5 * (least + most), 0.0, least, most};
}

/// Unless told, draws lie within three deviations; those of a logarithm may be as large as the limits allow.
Distribution readBell(ObjectReader& reader, const JsonNode& owner, const JsonNode& node, bool logarithm,
                      Limits limits, const Distribution& standard, Diagnostics& diagnostics) {
    const SchemaRule rule = reader.rule(logarithm ? "log_normal" : "normal");
    const auto shape = readPair(node, rule.item(0).limits(), rule.item(1).limits(),
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
    reader.number("min", result.minimum);
    reader.number("max", result.maximum);
    if (result.minimum > result.maximum)
        diagnostics.error(
            owner.where,
            fmt::format("`min` ({:.6g}) is above `max` ({:.6g})", result.minimum, result.maximum),
            logarithm ? "swap the two" : "what is not written is three deviations from the mean");
    return result;
}

Distribution distributionOf(const JsonNode& node, SchemaRule rule, const Distribution& standard,
                            Diagnostics& diagnostics) {
    const Limits limits = rule.limits();
    if (node.kind == JsonNode::Kind::number) {
        const double value = numberOf(node, limits, diagnostics).value_or(standard.mean);
        return {Distribution::Kind::constant, value, 0.0, value, value};
    }
    if (node.kind != JsonNode::Kind::object) {
        diagnostics.error(node.where,
                          fmt::format("expected a number or a distribution, found {}", node.kindName()),
                          kDistributionHint);
        return standard;
    }
    ObjectReader reader(node, rule, "a distribution", diagnostics);
    const JsonNode* uniform = reader.get("uniform");
    const JsonNode* normal = reader.get("normal");
    const JsonNode* log_normal = reader.get("log_normal");
    Distribution result = standard;
    if ((uniform != nullptr) + (normal != nullptr) + (log_normal != nullptr) != 1)
        diagnostics.error(node.where,
                          "a distribution needs exactly one of `uniform`, `normal` and `log_normal`",
                          kDistributionHint);
    else if (uniform)
        result = readUniform(reader, *uniform, standard, diagnostics);
    else
        result = readBell(reader, node, normal ? *normal : *log_normal, log_normal != nullptr, limits,
                          standard, diagnostics);
    reader.finish();
    return result;
}

/// What the schema itself says in a layout's words: a mistake there is one of the code.
template <class Read>
auto readOurs(Read read) {
    Diagnostics diagnostics;
    auto result = read(diagnostics);
    if (!diagnostics.entries.empty())
        throw std::logic_error("the schema breaks its own rules: " + diagnostics.entries.front().message);
    return result;
}

/// Speed, radius and reaction, where they are written.
void readPerson(ObjectReader& reader, PersonSettings& person, Diagnostics& diagnostics) {
    const PersonSettings standard;
    person.speed = readDistribution(reader, "speed", standard.speed, diagnostics);
    person.radius = readDistribution(reader, "radius", standard.radius, diagnostics);
    person.reaction = readDistribution(reader, "reaction", standard.reaction, diagnostics);
}

/// The schema has what makes a profile beside its name.
PersonSettings profileNamed(const std::string& name, SchemaRule people_rule) {
    return readOurs([&](Diagnostics& diagnostics) {
        const JsonNode& node = people_rule.property("profile").property(name).remark("x-people");
        PersonSettings person;
        ObjectReader reader(node, people_rule, fmt::format("the profile {}", name), diagnostics);
        readPerson(reader, person, diagnostics);
        reader.finish();
        return person;
    });
}

constexpr const char* kOfProfile = "profile";
constexpr const char* kOfAdult = "adult";
constexpr const char* kDisc = "disc";

BodySides readSides(ObjectReader& reader, Diagnostics& diagnostics) {
    const Distribution unread;
    return {readDistribution(reader, "breadth", unread, diagnostics),
            readDistribution(reader, "depth", unread, diagnostics)};
}

/// The schema has the sides of every body that has a name; whoever has none of its own has an adult's.
BodySides bodyNamed(const std::string& name, SchemaRule rule) {
    return readOurs([&](Diagnostics& diagnostics) {
        const JsonNode& bodies = rule.remark("x-bodies");
        const JsonNode* node = bodies.find(name);
        if (!node) node = bodies.find(kOfAdult);
        ObjectReader reader(*node, rule, fmt::format("the body {}", name), diagnostics);
        const BodySides sides = readSides(reader, diagnostics);
        reader.finish();
        return sides;
    });
}

/// Breadth and depth as a layout writes them. What is longer than broad has a name.
std::optional<BodySides> readOwnSides(const JsonNode& node, SchemaRule rule, Diagnostics& diagnostics) {
    ObjectReader reader(node, rule, "`body`", diagnostics);
    constexpr const char* kWhy = "a number or a distribution, m";
    const bool complete = reader.require("breadth", kWhy) && reader.require("depth", kWhy);
    if (!complete) {
        reader.finish();
        return std::nullopt;
    }
    const BodySides sides = readSides(reader, diagnostics);
    reader.finish();
    if (sides.depth.maximum > sides.breadth.minimum)
        diagnostics.error(
            node.where,
            fmt::format("a body is no deeper than broad: `depth` goes up to {:.6g} m, and `breadth` "
                        "begins at {:.6g} m",
                        sides.depth.maximum, sides.breadth.minimum),
            "give both `min` and `max`, or name one: for example \"body\": \"adult\"");
    return sides;
}

void giveBodies(People& people, const std::string& name, SchemaRule rule) {
    if (name == kDisc) return;
    for (PeopleShare& share : people.kinds)
        share.settings.body = bodyNamed(name == kOfProfile ? share.profile : name, rule);
}

/// Whoever has a `radius` is a disc.
void readBody(ObjectReader& people_reader, const JsonNode& people_node, SchemaRule people_rule,
              People& people, Diagnostics& diagnostics) {
    const SchemaRule rule = people_rule.property("body");
    const JsonNode* node = people_reader.get("body");
    const bool has_radius = people_node.find("radius") != nullptr;
    std::string name = kOfProfile;
    if (node && node->kind == JsonNode::Kind::object) {
        const std::optional<BodySides> sides = readOwnSides(*node, rule, diagnostics);
        for (PeopleShare& share : people.kinds)
            share.settings.body = sides;
    } else {
        Meanings<std::string> names;
        for (const char* each :
             {kOfProfile, kOfAdult, "child", "elderly", "suitcase", "wheelchair", "pram", kDisc})
            names.emplace_back(each, each);
        people_reader.choice("body", names, name);
        if (!node && has_radius) name = kDisc;
        giveBodies(people, name, rule);
    }
    if (node && has_radius && name != kDisc)
        diagnostics.error(node->where, "people are discs (`radius`) or have a `body`, not both",
                          "leave out one of the two");
}

void readProfile(ObjectReader& people_reader, const JsonNode& node, SchemaRule people_rule, People& people,
                 Diagnostics& diagnostics) {
    const SchemaRule rule = people_rule.property("profile");
    people.kinds.clear();
    if (node.kind == JsonNode::Kind::object) {
        ObjectReader reader(node, rule, "`profile`", diagnostics);
        for (const std::string& name : rule.keys()) {
            if (!node.find(name)) continue;
            double weight = 0.0;
            reader.number(name, weight);
            people.kinds.push_back({weight, profileNamed(name, people_rule), name});
        }
        reader.finish();
        if (people.kinds.empty())
            diagnostics.error(node.where, "`profile` names nobody",
                              R"(for example {"adult": 0.8, "child": 0.2})");
    } else if (const auto chosen = people_reader.word("profile")) {
        people.kinds.push_back({1.0, profileNamed(*chosen, people_rule), *chosen});
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

void readPartySizes(ObjectReader& people_reader, People& people, Diagnostics& diagnostics) {
    const JsonNode* node = people_reader.get("groups");
    if (!node || node->kind != JsonNode::Kind::array) {
        // The two crowds observed by Moussaid et al.: a street on a weekday, and one on a Saturday.
        people_reader.choice("groups",
                             {{"alone", People{}.party_sizes},
                              {"weekday", truncatedPoisson(0.83)},
                              {"leisure", truncatedPoisson(1.11)}},
                             people.party_sizes);
        return;
    }
    const Limits limits = people_reader.rule("groups").item().limits();
    people.party_sizes = {};
    if (node->items.empty() || node->items.size() > kLargestParty)
        diagnostics.error(
            node->where,
            fmt::format("expected one to {} weights: of people who walk alone, in twos, ...", kLargestParty),
            "for example [0.4, 0.4, 0.15, 0.05], or \"leisure\"");
    for (std::size_t i = 0; i < std::min(node->items.size(), kLargestParty); ++i)
        people.party_sizes[i] = numberOf(node->items[i], limits, diagnostics).value_or(0.0);
    if (std::accumulate(people.party_sizes.begin(), people.party_sizes.end(), 0.0) > 0.0) return;
    if (!diagnostics.hasErrors()) diagnostics.error(node->where, "all weights are zero");
    people.party_sizes = {1.0};
}

constexpr const char* kFans = "fans";

bool isColour(const JsonNode& node) {
    return node.kind == JsonNode::Kind::text && node.text.size() == 7 && node.text.front() == '#' &&
           node.text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
}

void readLook(ObjectReader& people_reader, People& people, Diagnostics& diagnostics) {
    Meanings<std::string> looks;
    for (const char* look : {"casual", "summer", "winter", "business", "sport", kFans})
        looks.emplace_back(look, look);
    people_reader.choice("look", looks, people.look);
    const std::size_t wanted = people_reader.rule("colours").leastItems();
    const JsonNode* node = people_reader.get("colours");
    if (!node) return;
    const char* const hint = R"(for example ["#a01020", "#ffffff"])";
    if (node->kind != JsonNode::Kind::array || node->items.size() != wanted) {
        diagnostics.error(node->where, fmt::format("expected {} colours", wanted), hint);
        return;
    }
    if (people.look != kFans)
        diagnostics.error(node->where, "only fans have colours of their own", R"(add "look": "fans")");
    for (const JsonNode& item : node->items) {
        if (!isColour(item))
            diagnostics.error(
                item.where,
                fmt::format("expected a colour, found {}",
                            item.kind == JsonNode::Kind::text ? "`" + item.text + "`" : item.kindName()),
                hint);
        people.colours.push_back(item.text);
    }
}

}  // namespace

Distribution readDistribution(ObjectReader& owner, const std::string& key, const Distribution& standard,
                              Diagnostics& diagnostics) {
    const SchemaRule rule = owner.rule(key);
    if (const JsonNode* ours = rule.standard())
        owner.expectSame(key, standard == readOurs([&](Diagnostics& mistakes) {
                                  return distributionOf(*ours, rule, standard, mistakes);
                              }));
    const JsonNode* node = owner.get(key);
    return node ? distributionOf(*node, rule, standard, diagnostics) : standard;
}

People readPeople(ObjectReader& owner, Diagnostics& diagnostics) {
    People people;
    const JsonNode* node = owner.get("people");
    const SchemaRule rule = owner.rule("people");
    if (!node) {
        giveBodies(people, kOfProfile, rule.property("body"));
        return people;
    }
    ObjectReader reader(*node, rule, "`people`", diagnostics);
    if (const JsonNode* profile = reader.get("profile"))
        readProfile(reader, *profile, rule, people, diagnostics);
    readPartySizes(reader, people, diagnostics);
    readLook(reader, people, diagnostics);
    readBody(reader, *node, rule, people, diagnostics);
    PersonSettings common;
    readPerson(reader, common, diagnostics);
    reader.number("maximum_speed_factor", common.maximum_speed_factor);
    reader.number("headway", common.headway);
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
