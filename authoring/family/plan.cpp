// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>

#include "authoring/family/family.h"
#include "authoring/family/named_files.h"
#include "authoring/layout/json_document.h"
#include "authoring/scene/random.h"
#include "base/numbers.h"

namespace throng::authoring {
namespace {

double standardNormal(double x) {
    return 0.5 * std::erfc(-x * std::sqrt(0.5));
}

/// The inverse of standardNormal(), by halving.
double standardNormalQuantile(double share) {
    double low = -38.0;
    double high = 38.0;  // beyond, doubles know nothing but 0 and 1
    for (int i = 0; i < 200 && high - low > 1.0e-12; ++i) {
        const double middle = 0.5 * (low + high);
        (standardNormal(middle) < share ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// A normal distribution without the tails beyond the limits.
double normalQuantile(const Axis& axis, double share) {
    const bool logarithm = axis.kind == Axis::Kind::log_normal;
    const auto standard = [&](double limit) {
        const double value = logarithm ? (limit > 0.0 ? std::log(limit) : -HUGE_VAL) : limit;
        return standardNormal((value - axis.a) / axis.b);
    };
    const double low = standard(axis.minimum);
    const double high = standard(axis.maximum);
    const double value = axis.a + axis.b * standardNormalQuantile(low + share * (high - low));
    return std::clamp(logarithm ? std::exp(value) : value, axis.minimum, axis.maximum);
}

/// The value below which this share, [0, 1), of all draws are.
Json quantile(const Axis& axis, double share) {
    if (axis.kind == Axis::Kind::values) {
        const auto count = axis.values.size();
        if (axis.weights.empty())
            return axis
                .values[std::min(count - 1, static_cast<std::size_t>(share * static_cast<double>(count)))];
        double left = share * std::accumulate(axis.weights.begin(), axis.weights.end(), 0.0);
        for (std::size_t i = 0; i + 1 < count; ++i) {
            left -= axis.weights[i];
            if (left < 0.0) return axis.values[i];
        }
        return axis.values.back();
    }
    if (axis.kind == Axis::Kind::uniform && axis.whole)
        return static_cast<std::int64_t>(axis.a + std::floor(share * (axis.b - axis.a + 1.0)));
    const double value =
        axis.kind == Axis::Kind::uniform ? axis.a + share * (axis.b - axis.a) : normalQuantile(axis, share);
    if (axis.whole) return static_cast<std::int64_t>(std::llround(value));
    return readable(value);
}

Scenario gridPoint(const Family& family, std::uint64_t index) {
    Scenario scenario;
    // The last axis runs fastest, as one reads.
    for (auto axis = family.axes.rbegin(); axis != family.axes.rend(); ++axis) {
        const std::size_t count = axis->values.size();
        scenario.parameters.emplace_back(axis->name, count ? axis->values[index % count] : Json());
        index /= std::max<std::size_t>(count, 1);
    }
    std::reverse(scenario.parameters.begin(), scenario.parameters.end());
    return scenario;
}

/// A seeded permutation of 0 .. count - 1 (Fisher and Yates).
std::vector<std::uint64_t> permutation(std::uint64_t count, const GroupRandom& random) {
    std::vector<std::uint64_t> order(count);
    std::iota(order.begin(), order.end(), std::uint64_t{0});
    for (std::uint64_t i = count; i > 1; --i)
        std::swap(order[i - 1], order[random.word(i, Purpose::choice) % i]);
    return order;
}

std::vector<Scenario> drawn(const Family& family) {
    std::vector<Scenario> scenarios(family.count);
    for (const Axis& axis : family.axes) {
        if (axis.kind == Axis::Kind::formula) {
            for (Scenario& scenario : scenarios)
                scenario.parameters.emplace_back(axis.name, Json());
            continue;
        }
        const GroupRandom random(family.seed, axis.name);
        const std::vector<std::uint64_t> order = family.sampling == Sampling::latin
                                                     ? permutation(family.count, random)
                                                     : std::vector<std::uint64_t>{};
        for (std::uint64_t i = 0; i < family.count; ++i) {
            double share = random.unit(i, Purpose::goal_x);
            if (!order.empty())
                share = (static_cast<double>(order[i]) + share) / static_cast<double>(family.count);
            scenarios[i].parameters.emplace_back(axis.name, quantile(axis, share));
        }
    }
    return scenarios;
}

/// As many digits as numbers are written with, so that 0.1 * 3 is 0.3; whole ones are whole.
Json calculated(double value, bool whole) {
    constexpr double kExact = 0x1.0p53;
    const double result = whole ? std::round(value) : withDigits(value, 12);
    if (result == std::floor(result) && std::abs(result) <= kExact) return static_cast<std::int64_t>(result);
    return result;
}

/// Gives each formula its value, in the order of the axes.
void calculate(const Family& family, Scenario& scenario) {
    for (std::size_t i = 0; i < family.axes.size(); ++i) {
        const Axis& axis = family.axes[i];
        if (axis.kind != Axis::Kind::formula) continue;
        const auto value_of = [&](const std::string& name) {
            const auto known =
                std::ranges::find(scenario.parameters, name, &std::pair<std::string, Json>::first);
            return known->second.get<double>();
        };
        try {
            scenario.parameters[i].second = calculated(axis.formula.evaluate(value_of), axis.whole);
        } catch (const FormulaError& error) {
            std::erase_if(scenario.parameters, [](const auto& each) { return each.second.is_null(); });
            throw PlanError(fmt::format("`{}` has no value where it is {}: {}", axis.name, describe(scenario),
                                        error.what()),
                            axis.formulaPlace(error.at));
        }
    }
}

std::optional<std::size_t> indexOf(const std::string& key) {
    std::size_t index = 0;
    const char* const end = key.data() + key.size();
    const auto [stop, error] = std::from_chars(key.data(), end, index);
    return error == std::errc() && stop == end ? std::optional(index) : std::nullopt;
}

Json& itemOfId(Json& list, const std::string& id, const std::string& pointer) {
    std::vector<std::string> known;
    for (Json& item : list) {
        if (!item.is_object() || !item.contains("id") || !item["id"].is_string()) continue;
        if (item["id"] == id) return item;
        known.push_back(item["id"]);
    }
    throw std::invalid_argument(fmt::format("`{}`: {}", pointer, noSuchId(id, known)));
}

/// Members that are missing are added, as `--set` does; the layout's reader judges them. A list that is
/// missing begins with its first item: nobody gets a million of them by naming the last.
void setAt(Json& layout, const std::string& pointer, const Json& value) {
    std::vector<std::string> keys;
    for (Json::json_pointer left(pointer); !left.empty(); left.pop_back())
        keys.push_back(left.back());
    Json* at = &layout;
    Json::json_pointer holder;
    bool is_new = false;
    for (auto key = keys.rbegin(); key != keys.rend(); ++key) {
        if (is_new) *at = *key == "0" ? Json::array({nullptr}) : Json::object();
        if (at->is_array() && *key == kById && std::next(key) != keys.rend()) {
            holder.push_back(*key++);
            at = &itemOfId(*at, *key, pointer);
        } else if (at->is_array()) {
            const std::optional<std::size_t> index = indexOf(*key);
            if (!index || *index >= at->size())
                throw std::invalid_argument(
                    fmt::format("`{}`: `{}` has {} items", pointer, holder.to_string(), at->size()));
            at = &(*at)[*index];
        } else if (at->is_object()) {
            is_new = !at->contains(*key);
            at = &(*at)[*key];
        } else {
            throw std::invalid_argument(fmt::format("`{}`: `{}` is {}: there is nothing inside", pointer,
                                                    holder.to_string(), at->type_name()));
        }
        holder.push_back(*key);
    }
    *at = value;
}

}  // namespace

SourcePosition Axis::formulaPlace(std::size_t letter) const {
    SourcePosition place = formula_where;
    if (place.line > 0) place.column += 1 + static_cast<int>(letter);  // behind its quotation mark
    return place;
}

double countOf(const Family& family) {
    if (family.sampling != Sampling::grid) return static_cast<double>(family.count);
    double count = 1.0;
    for (const Axis& axis : family.axes)
        if (axis.kind != Axis::Kind::formula) count *= static_cast<double>(axis.values.size());
    return count;
}

std::vector<Scenario> planFamily(const Family& family) {
    std::vector<Scenario> scenarios;
    if (family.sampling == Sampling::grid)
        for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(countOf(family)); ++i)
            scenarios.push_back(gridPoint(family, i));
    else
        scenarios = drawn(family);
    for (Scenario& scenario : scenarios)
        calculate(family, scenario);
    std::set<std::string> known;
    std::erase_if(scenarios,
                  [&](const Scenario& scenario) { return !known.insert(describe(scenario)).second; });
    return scenarios;
}

Json composeLayout(const Family& family, const Scenario& scenario) {
    Json layout = family.base;
    if (family.generator) {
        GeneratorValues values(family.generator->parameters);
        for (const auto& [name, value] : family.generator_values)
            values.set(name, value);
        for (std::size_t i = 0; i < family.axes.size(); ++i) {
            const Json& value = scenario.parameters[i].second;
            if (family.axes[i].parameter.empty()) continue;
            if (!value.is_number())
                throw std::invalid_argument(
                    fmt::format("`{}` is a number, not {}", family.axes[i].parameter, value.dump()));
            values.set(family.axes[i].parameter, value.get<double>());
        }
        layout = family.generator->make(values);
    }
    for (std::size_t i = 0; i < family.axes.size(); ++i) {
        const Axis& axis = family.axes[i];
        const Json& value = scenario.parameters[i].second;
        for (const std::string& pointer : axis.pointers)
            setAt(layout, pointer, value);
        if (axis.cases.empty()) continue;
        const auto name = std::ranges::find(axis.values, value);
        for (const auto& [pointer, its] : axis.cases[static_cast<std::size_t>(name - axis.values.begin())])
            setAt(layout, pointer, its);
    }
    placeFiles(layout, family.folder);
    return layout;
}

std::string describe(const Scenario& scenario) {
    std::string text;
    for (const auto& [name, value] : scenario.parameters)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, value.dump());
    return text.empty() ? "as it is" : text;
}

}  // namespace throng::authoring
