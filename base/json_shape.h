// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace throng {

/// What is read of any JSON. What copies and writes JSON calls itself for every bracket in a bracket and runs
/// out of stack; what keeps keys in the order of the file looks through all of them for each.
constexpr std::size_t kMostDepth = 64;
constexpr std::size_t kMostKeys = 2000;  ///< of one object

/// What a text has more of than that, to be read after "it": nothing where it may be parsed. It need not be
/// JSON.
const char* tooMuchIn(std::string_view json);

}  // namespace throng
