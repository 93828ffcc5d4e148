// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/text/printable.h"

namespace throng::cli {

/// Prints for people. Names come from files, and these from anywhere: what is not to be seen is written out.
template <class... Values>
void say(std::FILE* to, fmt::format_string<Values...> format, Values&&... values) {
    fmt::print(to, "{}", printable(fmt::format(format, std::forward<Values>(values)...), true));
}

/// Prints a document on standard output, whatever texts are in it.
inline void sayJson(const nlohmann::ordered_json& document) {
    fmt::print("{}\n", document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace throng::cli
