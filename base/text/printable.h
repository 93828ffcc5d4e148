// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace throng {

/// Text from a file as a terminal may show it: control characters, those that turn the direction of writing,
/// and bytes that are no UTF-8 are written out ("\x1b").
/// @param lines line breaks and tabs stay
std::string printable(std::string_view text, bool lines = false);

/// As much of a text as one reads in a message.
std::string shortened(std::string text);

/// Whether a text can be the name of one file or folder inside another: neither empty, `.` nor `..`, without
/// slashes and control characters, and short enough for file systems.
bool isFileName(std::string_view name);

}  // namespace throng
