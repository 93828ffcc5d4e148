// SPDX-License-Identifier: Apache-2.0
#include "base/files/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "base/files/descriptor.h"

namespace throng {

static_assert(std::endian::native == std::endian::little, "the streams are written as they lie in memory");
static_assert(sizeof(off_t) == 8, "files beyond 2 GiB need 64-bit offsets");

OutputError::OutputError(const std::filesystem::path& path, const std::string& action, int error_number)
    : std::runtime_error("cannot " + action + " " + path.string() + ": " +
                         std::generic_category().message(error_number)),
      path_(path),
      error_number_(error_number) {}

OutputError::OutputError(const std::filesystem::path& path, const std::string& message)
    : std::runtime_error(path.string() + ": " + message), path_(path) {}

OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)) {
    descriptor_ = ::open(path_.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0666);
    if (descriptor_ < 0) throw OutputError(path_, "create", errno);
}

OutputFile OutputFile::goOn(std::filesystem::path path, std::uint64_t position) {
    OutputFile file;
    file.path_ = std::move(path);
    file.position_ = position;
    file.descriptor_ = ::open(file.path_.c_str(), O_RDWR | O_CLOEXEC);
    if (file.descriptor_ < 0) throw OutputError(file.path_, "go on with", errno);
    const off_t size = ::lseek(file.descriptor_, 0, SEEK_END);
    if (size < static_cast<off_t>(position))
        throw OutputError(file.path_, "is shorter than the checkpoint says; start over with --force");
    if (::ftruncate(file.descriptor_, static_cast<off_t>(position)) != 0)
        throw OutputError(file.path_, "cut", errno);
    return file;
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      position_(other.position_) {}

OutputFile::~OutputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::write(std::span<const std::byte> bytes) {
    writeAt(position_, bytes);
    position_ += bytes.size();
}

void OutputFile::writeAt(std::uint64_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (written < 0 && errno == EINTR) continue;
        // A write of nothing without an error would loop for ever; no file system explains it better than
        // this.
        if (written <= 0) throw OutputError(path_, "write", written < 0 ? errno : ENOSPC);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        offset += static_cast<std::uint64_t>(written);
    }
}

void OutputFile::readAt(std::uint64_t offset, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t got = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) throw OutputError(path_, "read back", got < 0 ? errno : EIO);
        bytes = bytes.subspan(static_cast<std::size_t>(got));
        offset += static_cast<std::uint64_t>(got);
    }
}

void OutputFile::flush() {
    if (::fdatasync(descriptor_) != 0) throw OutputError(path_, "flush", errno);
}

void OutputFile::finish() {
    if (::fsync(descriptor_) != 0) throw OutputError(path_, "flush", errno);
    const int descriptor = std::exchange(descriptor_, -1);
    if (::close(descriptor) != 0) throw OutputError(path_, "close", errno);
}

namespace {

/// Writes under another name in the same folder. @returns its path
std::filesystem::path writtenBeside(const std::filesystem::path& path, std::string_view content) {
    std::filesystem::path fresh = path.string() + fmt::format(".new-{}", ::getpid());
    std::error_code ignored;
    std::filesystem::remove(fresh, ignored);  // of a process that was killed
    writeFile(fresh, content);
    return fresh;
}

}  // namespace

void writeFile(const std::filesystem::path& path, std::string_view content) {
    OutputFile file(path);
    try {
        file.write(content);
        file.finish();
    } catch (const OutputError&) {
        std::error_code ignored;
        std::filesystem::remove(path, ignored);  // rather none than half of one
        throw;
    }
}

bool renameNoReplace(const std::filesystem::path& from, const std::filesystem::path& to) {
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
    if (errno == EEXIST) return false;
    if (errno != EINVAL && errno != ENOSYS) throw OutputError(to, "give the finished work the name", errno);
    // Some network file systems know no flags for renaming: there, a rename after a check is the best there
    // is, and it still cannot replace a folder that has files in it.
    if (std::filesystem::exists(std::filesystem::symlink_status(to))) return false;
    if (::rename(from.c_str(), to.c_str()) == 0) return true;
    if (errno == EEXIST || errno == ENOTEMPTY) return false;
    throw OutputError(to, "give the finished work the name", errno);
}

void writeNewFile(const std::filesystem::path& path, std::string_view content) {
    std::error_code ignored;
    const auto isTaken = [&] {
        return std::filesystem::exists(std::filesystem::symlink_status(path, ignored));
    };
    if (isTaken()) throw OutputError(path, "create", EEXIST);
    const std::filesystem::path fresh = writtenBeside(path, content);
    try {
        if (!renameNoReplace(fresh, path)) throw OutputError(path, "create", EEXIST);
    } catch (const OutputError&) {
        std::filesystem::remove(fresh, ignored);
        throw;
    }
}

void replaceFile(const std::filesystem::path& path, std::string_view content) {
    const std::filesystem::path fresh = writtenBeside(path, content);
    std::error_code ignored;
    if (::rename(fresh.c_str(), path.c_str()) == 0) return;
    const int reason = errno;
    std::filesystem::remove(fresh, ignored);
    throw OutputError(path, "replace", reason);
}

void syncFile(const std::filesystem::path& path) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.isOpen()) throw OutputError(path, "open", errno);
    if (::fsync(file.get()) != 0) throw OutputError(path, "flush", errno);
}

void removeFile(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::remove(path, error);
    if (error) throw OutputError(path, "remove", error.value());
}

void syncFolder(const std::filesystem::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) throw OutputError(folder, "open", errno);
    const int result = ::fsync(descriptor);
    const int reason = errno;
    ::close(descriptor);
    // Some network file systems have no notion of flushing a folder and say EINVAL: nothing more can be done
    // there.
    if (result != 0 && reason != EINVAL) throw OutputError(folder, "flush", reason);
}

void makeFolder(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) throw OutputError(path, "cannot be made: " + error.message());
}

}  // namespace throng
