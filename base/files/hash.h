// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/files/input_file.h"

namespace throng {

/// XXH3, 64 bits, seed 0, as 16 hexadecimal digits (the canonical form: most significant first).
std::string hashText(std::string_view text);

/// The same of something that comes in pieces.
class Hasher {
  public:
    Hasher();
    ~Hasher();
    Hasher(Hasher&&) noexcept;
    Hasher& operator=(Hasher&&) noexcept;
    void add(std::span<const std::byte> bytes);
    std::uint64_t digest() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

struct FileHash {
    std::uint64_t bytes = 0;
    std::string xxh3;  ///< 16 hexadecimal digits
    bool operator==(const FileHash&) const = default;
};

/// Reads the whole file, in pieces. Throws InputError.
/// @param advance called after each piece with its bytes
FileHash hashFile(const InputFile& file, const std::function<void(std::uint64_t bytes)>& advance = {});
FileHash hashFile(const std::filesystem::path& path);

}  // namespace throng
