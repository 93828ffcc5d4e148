// SPDX-License-Identifier: Apache-2.0
#include "base/files/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace throng {
namespace {

[[noreturn]] void tooLarge(const std::filesystem::path& path, std::uint64_t limit) {
    throw InputError(
        path, fmt::format("is larger than the {} that can be read", fmt::format("{} MiB", limit >> 20)));
}

}  // namespace

// Without O_NONBLOCK, a named pipe in the place of a file would wait for a writer for ever.
InputFile::InputFile(std::filesystem::path path)
    : InputFile(path, Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK))) {}

InputFile::InputFile(std::filesystem::path path, Descriptor file)
    : path_(std::move(path)), file_(std::move(file)) {
    if (!file_.isOpen()) throw InputError(path_, "cannot open: " + std::generic_category().message(errno));
    struct stat facts {};
    if (::fstat(file_.get(), &facts) != 0 || !S_ISREG(facts.st_mode))
        throw InputError(path_,
                         S_ISDIR(facts.st_mode) ? "is a folder; a file was expected" : "not a regular file");
    size_ = static_cast<std::uint64_t>(facts.st_size);
}

void InputFile::readAt(std::uint64_t offset, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t got = ::pread(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw InputError(path_, "cannot read: " + std::generic_category().message(errno));
        if (got == 0) throw InputError(path_, fmt::format("ends before byte {}", offset + bytes.size()));
        bytes = bytes.subspan(static_cast<std::size_t>(got));
        offset += static_cast<std::uint64_t>(got);
    }
}

std::string readFile(const std::filesystem::path& path, std::uint64_t limit) {
    const InputFile file(path);
    if (file.size() > limit) tooLarge(path, limit);
    std::string content(static_cast<std::size_t>(file.size()), '\0');
    file.readAt(0, std::as_writable_bytes(std::span(content)));
    return content;
}

std::string readStandardInput(std::uint64_t limit) {
    const std::filesystem::path name("standard input");
    std::string content;
    std::array<char, 65536> piece;
    while (true) {
        const ssize_t got = ::read(STDIN_FILENO, piece.data(), piece.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw InputError(name, "cannot read: " + std::generic_category().message(errno));
        if (got == 0) return content;
        content.append(piece.data(), static_cast<std::size_t>(got));
        if (content.size() > limit) tooLarge(name, limit);
    }
}

}  // namespace throng
