// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "base/files/errors.h"

namespace throng {

/// A new file whose every write is checked: all members throw OutputError. Writes go straight to the system,
/// so callers hand over large pieces. Offsets are 64 bits wide.
class OutputFile {
  public:
    /// Creates `path`; an error if it exists.
    explicit OutputFile(std::filesystem::path path);
    /// Goes on with a file that is there: cuts off what it has beyond `position`; an error if it is shorter.
    static OutputFile goOn(std::filesystem::path path, std::uint64_t position);
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&&) = delete;
    ~OutputFile();

    /// Appends at the current end of what was written.
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text))); }
    /// Overwrites, or extends past the end; the place where write() goes on does not move.
    void writeAt(std::uint64_t offset, std::span<const std::byte> bytes);
    /// Fills all of `bytes`; an error if the file is shorter.
    void readAt(std::uint64_t offset, std::span<std::byte> bytes) const;
    /// Waits until what was written is on the disk.
    void flush();
    std::uint64_t position() const { return position_; }
    /// Waits until the data is on the disk, then closes. Without it the destructor closes and nobody hears of
    /// errors.
    void finish();

    const std::filesystem::path& path() const { return path_; }

  private:
    OutputFile() = default;

    std::filesystem::path path_;
    int descriptor_ = -1;
    std::uint64_t position_ = 0;
};

/// Writes a whole small file: create, write, sync, close. Throws OutputError.
void writeFile(const std::filesystem::path& path, std::string_view content);

/// The same for a file that may exist: it has its old content or the new one, never something in between.
void replaceFile(const std::filesystem::path& path, std::string_view content);

/// The same under a name that nothing may have yet. Throws OutputError.
void writeNewFile(const std::filesystem::path& path, std::string_view content);

/// Renames without ever replacing. Throws OutputError. @returns false when `to` exists
bool renameNoReplace(const std::filesystem::path& from, const std::filesystem::path& to);

/// Puts what somebody else wrote into a file on the disk. Throws OutputError.
void syncFile(const std::filesystem::path& path);

/// Removes a file, if it is there. Throws OutputError.
void removeFile(const std::filesystem::path& path);

/// Makes the names inside a folder durable. Throws OutputError.
void syncFolder(const std::filesystem::path& folder);

/// Makes a folder and its parents, unless they are there. @throws OutputError
void makeFolder(const std::filesystem::path& path);

}  // namespace throng
