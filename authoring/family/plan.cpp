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

/// Six digits say enough, read well, and are the same wherever they are printed.
double readable(double value) {
    return withDigits(value, 6);
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
        scenario.parameters.emplace_back(axis->name, axis->values[index % axis->values.size()]);
        index /= axis->values.size();
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

std::optional<std::size_t> indexOf(const std::string& key) {
    std::size_t index = 0;
    const char* const end = key.data() + key.size();
    const auto [stop, error] = std::from_chars(key.data(), end, index);
    return error == std::errc() && stop == end ? std::optional(index) : std::nullopt;
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
        if (at->is_array()) {
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

double countOf(const Family& family) {
    if (family.sampling != Sampling::grid) return static_cast<double>(family.count);
    double count = 1.0;
    for (const Axis& axis : family.axes)
        count *= static_cast<double>(axis.values.size());
    return count;
}

std::vector<Scenario> planFamily(const Family& family) {
    std::vector<Scenario> scenarios;
    if (family.sampling == Sampling::grid)
        for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(countOf(family)); ++i)
            scenarios.push_back(gridPoint(family, i));
    else
        scenarios = drawn(family);
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
    for (std::size_t i = 0; i < family.axes.size(); ++i)
        for (const std::string& pointer : family.axes[i].pointers)
            setAt(layout, pointer, scenario.parameters[i].second);
    return layout;
}

std::string describe(const Scenario& scenario) {
    std::string text;
    for (const auto& [name, value] : scenario.parameters)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, value.dump());
    return text.empty() ? "as it is" : text;
}

}  // namespace throng::authoring
