// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "json_mutator.h"

/// A folder as one input. For each file: one byte, the length of its name, the name, four bytes, the file's
/// length (little endian), the file. tests/fuzz/make_corpora.py writes the same.
namespace throng::fuzz {

using Parts = std::vector<std::pair<std::string, std::string>>;  ///< names and contents

/// What can be understood of it.
Parts unpacked(std::string_view input);
std::string packed(const Parts& parts);

/// Changes one of the files: JSON as JSON, anything else as bytes.
std::string mutatedPart(std::string_view input, const JsonMutator& json, std::size_t most, unsigned seed);

/// Writes the files of these names into `folder` of the fuzzer's folder; those that the input lacks are not
/// there.
void putParts(const Parts& parts, const std::string& folder, std::span<const char* const> names);

}  // namespace throng::fuzz
