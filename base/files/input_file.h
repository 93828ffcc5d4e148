// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "base/files/descriptor.h"
#include "base/files/errors.h"

namespace throng {

/// A regular file opened for reading: nothing blocks on a named pipe, no device is read without end. All
/// members throw InputError.
class InputFile {
  public:
    explicit InputFile(std::filesystem::path path);
    /// One that is open already; `path` is its name in messages.
    InputFile(std::filesystem::path path, Descriptor file);

    /// Bytes, as of the moment it was opened.
    std::uint64_t size() const { return size_; }
    /// Fills all of `bytes`; an error if the file ends before.
    void readAt(std::uint64_t offset, std::span<std::byte> bytes) const;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    Descriptor file_;
    std::uint64_t size_ = 0;
};

/// Bytes that a text file may have: a layout, a family, a shader, what is known of a bake.
constexpr std::uint64_t kMostText = std::uint64_t{256} << 20;
/// Bytes that a table of people may have.
constexpr std::uint64_t kMostTable = std::uint64_t{1} << 30;

/// The whole of a file. Throws InputError, also when it is larger than `limit` bytes.
std::string readFile(const std::filesystem::path& path, std::uint64_t limit = kMostText);

/// The whole of standard input, from wherever it comes; InputError when it is larger.
std::string readStandardInput(std::uint64_t limit = kMostText);

}  // namespace throng
