// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

/// What all fuzzers of tests/fuzz share. Each defines readOne(); support/harness.cpp calls it with whatever
/// libFuzzer makes, within bounds: memory at most ten times the input and 256 MiB, and 10 s of processor
/// time.
namespace throng::fuzz {

/// Reads one input as the program reads such a file, and all that stands behind. An InputError says that a
/// file is not sound, which is an answer; anything else that leaves this function is a finding.
void readOne(std::string_view input);

/// A folder of this process alone, which goes with it.
const std::filesystem::path& folder();

/// Writes a file of that folder, and the folders that it lies in.
/// @returns its path
std::filesystem::path put(const std::string& name, std::string_view bytes);

/// Ends the process with a finding, in words.
[[noreturn]] void finding(const std::string& what);

/// libFuzzer's own mutation of bytes.
/// @returns at most `most` bytes
std::string mutatedBytes(std::string_view bytes, std::size_t most);

}  // namespace throng::fuzz
