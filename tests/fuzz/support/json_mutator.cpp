// SPDX-License-Identifier: Apache-2.0
#include "json_mutator.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "base/json_shape.h"
#include "harness.h"

namespace throng::fuzz {
namespace {

using Json = JsonMutator::Json;

std::size_t below(std::size_t count, std::mt19937& random) {
    return count ? random() % count : 0;
}

std::string textOf(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Not even a fuzzer parses what nobody would.
Json parsed(std::string_view text) {
    return tooMuchIn(text) ? Json(Json::value_t::discarded) : Json::parse(text, nullptr, false);
}

Json nudged(const Json& number, std::mt19937& random) {
    const double value = number.get<double>();
    switch (below(8, random)) {
        case 0:
            return -value;
        case 1:
            return 2.0 * value;
        case 2:
            return 0.5 * value;
        case 3:
            return value + 1.0;
        case 4:
            return value - 1.0;
        case 5:
            return std::nextafter(value, HUGE_VAL);
        case 6:
            return value * (0.9 + 0.2 * static_cast<double>(random() % 1000) / 1000.0);
        default:
            if (std::abs(value) < 1.0e15) return static_cast<std::int64_t>(value);
            return 1000.0 * value;
    }
}

}  // namespace

JsonMutator::JsonMutator(std::initializer_list<std::string_view> schemas) {
    for (const std::string_view schema : schemas)
        learn(Json::parse(schema));
    std::ranges::sort(words_);
    words_.erase(std::unique(words_.begin(), words_.end()), words_.end());
    std::ranges::sort(numbers_);
    numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
}

void JsonMutator::learn(const Json& value) {
    constexpr std::size_t kLongestWord = 40;  // what is longer explains something
    if (value.is_number()) numbers_.push_back(value.get<double>());
    if (value.is_string() && value.get_ref<const std::string&>().size() <= kLongestWord)
        words_.push_back(value.get<std::string>());
    if (!value.is_structured()) return;  // a scalar would have itself as its one item
    for (const auto& [key, inside] : value.items()) {
        if (value.is_object()) words_.push_back(key);
        learn(inside);
    }
}

void JsonMutator::collect(Json& value, Json* parent, std::size_t index, std::vector<Node>& nodes) {
    nodes.push_back({&value, parent, index});
    std::size_t i = 0;
    if (value.is_structured())
        for (Json& inside : value)
            collect(inside, &value, i++, nodes);
}

Json JsonMutator::anything(std::mt19937& random) const {
    static const std::vector<Json> rare = {nullptr,
                                           true,
                                           false,
                                           0,
                                           1,
                                           -1,
                                           2,
                                           0.5,
                                           -0.0,
                                           1.0e-300,
                                           1.0e300,
                                           1.0e18,
                                           1e9,
                                           65536,
                                           1000000,
                                           65535,
                                           4294967295,
                                           1.0e-10,
                                           "",
                                           Json::array(),
                                           9007199254740992,
                                           9223372036854775807,
                                           -9223372036854775807,
                                           18446744073709551615u,
                                           Json::object(),
                                           Json::array({0, 0}),
                                           Json::array({0, 0, 0}),
                                           std::string(300, 'a'),
                                           "\xef\xbf\xbd\x1b[31m"};
    const std::size_t kind = below(3, random);
    if (kind == 0 && !words_.empty()) return words_[below(words_.size(), random)];
    if (kind == 1 && !numbers_.empty()) {
        const double number = numbers_[below(numbers_.size(), random)];
        const double steps[] = {number, number, number + 1.0, number - 1.0, std::nextafter(number, HUGE_VAL),
                                -number};
        return steps[below(std::size(steps), random)];
    }
    return rare[below(rare.size(), random)];
}

void JsonMutator::grow(Json& value, const Json& root, std::mt19937& random) const {
    Json copy = root;
    std::vector<Node> nodes;
    collect(copy, nullptr, 0, nodes);
    const Json inside = below(2, random) ? anything(random) : *nodes[below(nodes.size(), random)].value;
    if (value.is_object() && !words_.empty()) {
        value[words_[below(words_.size(), random)]] = inside;
    } else if (value.is_array()) {
        // One more of its own kind, or many.
        const Json item =
            value.empty() || below(4, random) == 0 ? inside : value[below(value.size(), random)];
        const std::size_t count = below(8, random) == 0 ? 1 + below(300, random) : 1;
        for (std::size_t i = 0; i < count; ++i)
            value.push_back(item);
    } else {
        value = inside;
    }
}

void JsonMutator::change(Json& root, std::mt19937& random) const {
    std::vector<Node> nodes;
    collect(root, nullptr, 0, nodes);
    const Node node = nodes[below(nodes.size(), random)];
    Json& value = *node.value;
    switch (below(8, random)) {
        case 0:
            value = anything(random);
            break;
        case 1:
        case 2:
            if (value.is_number())
                value = nudged(value, random);
            else if (value.is_string())
                value =
                    mutatedBytes(value.get<std::string>(), value.get_ref<const std::string&>().size() + 8);
            else
                grow(value, root, random);
            break;
        case 3:
            if (node.parent)
                node.parent->erase(std::next(node.parent->begin(), static_cast<std::ptrdiff_t>(node.index)));
            break;
        case 4:
            grow(node.parent ? *node.parent : value, root, random);
            break;
        case 5: {
            const Json other = *nodes[below(nodes.size(), random)].value;
            value = other;
            break;
        }
        case 6:
            value = below(2, random) ? Json::array({Json(value)}) : Json::object({{"at", Json(value)}});
            break;
        default:
            if (value.is_array() && value.size() > 1)
                std::swap(value[below(value.size(), random)], value[below(value.size(), random)]);
            else
                value = anything(random);
    }
}

std::string JsonMutator::mutate(std::string_view text, std::size_t most, unsigned seed) const {
    std::mt19937 random(seed);
    constexpr std::size_t kAsBytes = 12;  // one in so many
    Json root = below(kAsBytes, random) == 0 ? Json(Json::value_t::discarded) : parsed(text);
    if (root.is_discarded()) return mutatedBytes(text, most);
    for (std::size_t left = 1 + below(3, random); left > 0; --left)
        change(root, random);
    const std::string changed = textOf(root);
    return changed.size() <= most ? changed : mutatedBytes(text, most);
}

std::string JsonMutator::cross(std::string_view one, std::string_view other, std::size_t most,
                               unsigned seed) const {
    std::mt19937 random(seed);
    Json root = parsed(one), source = parsed(other);
    if (root.is_discarded() || source.is_discarded()) return std::string(one.substr(0, most));
    std::vector<Node> here, there;
    collect(root, nullptr, 0, here);
    collect(source, nullptr, 0, there);
    const Json taken = *there[below(there.size(), random)].value;
    Json& place = *here[below(here.size(), random)].value;
    if (place.is_array() && below(2, random))
        place.push_back(taken);
    else
        place = taken;
    const std::string changed = textOf(root);
    return changed.size() <= most ? changed : std::string(one.substr(0, most));
}

}  // namespace throng::fuzz
