// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace throng::authoring {

/// The word among `known` that `word` was probably meant to be, or nothing.
std::string nearestWord(std::string_view word, const std::vector<std::string>& known);
/// "did you mean `width`?", or "one of: a, b, c" where nothing is near.
std::string hintFor(std::string_view word, const std::vector<std::string>& known);

}  // namespace throng::authoring
