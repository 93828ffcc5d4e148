// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace throng::fuzz {

/// Changes JSON so that it stays JSON: bytes alone seldom get past a parser. Keys, words and numbers come
/// from schemas.
class JsonMutator {
  public:
    using Json = nlohmann::ordered_json;

    /// @param schemas JSON Schemas, or any JSON whose keys, texts and numbers are worth trying
    explicit JsonMutator(std::initializer_list<std::string_view> schemas);

    /// Another text of at most `most` bytes. What is no JSON, and now and then what is, is changed as bytes.
    std::string mutate(std::string_view text, std::size_t most, unsigned seed) const;
    /// The one with something of the other in it.
    std::string cross(std::string_view one, std::string_view other, std::size_t most, unsigned seed) const;

  private:
    struct Node {
        Json* value;
        Json* parent;  ///< null for the root
        std::size_t index;
    };
    static void collect(Json& value, Json* parent, std::size_t index, std::vector<Node>& nodes);
    void learn(const Json& value);
    void change(Json& root, std::mt19937& random) const;
    void grow(Json& value, const Json& root, std::mt19937& random) const;
    Json anything(std::mt19937& random) const;

    std::vector<std::string> words_;
    std::vector<double> numbers_;
};

}  // namespace throng::fuzz
