// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "base/files/errors.h"

namespace throng {

/// A regular file opened for reading; all members throw InputError.
class InputFile {
  public:
    explicit InputFile(std::filesystem::path path);
    InputFile(InputFile&& other) noexcept;
    InputFile& operator=(InputFile&&) = delete;
    ~InputFile();

    /// Bytes, as of the moment it was opened.
    std::uint64_t size() const { return size_; }
    /// Fills all of `bytes`; an error if the file ends before.
    void readAt(std::uint64_t offset, std::span<std::byte> bytes) const;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

/// The whole of a text file. Throws InputError, also when it is larger than `limit` bytes.
std::string readFile(const std::filesystem::path& path, std::uint64_t limit = std::uint64_t{1} << 30);

}  // namespace throng
