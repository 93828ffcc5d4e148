// SPDX-License-Identifier: Apache-2.0
#include "base/files/beneath.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/openat2.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <iterator>
#include <span>
#include <system_error>
#include <utility>

#include "base/files/descriptor.h"
#include "base/files/errors.h"

namespace throng {
namespace fs = std::filesystem;
namespace {

// Without O_NONBLOCK, a named pipe would wait for a writer for ever.
constexpr int kReading = O_RDONLY | O_CLOEXEC | O_NONBLOCK;

/// For kernels and sandboxes without openat2: name by name, and no links at all.
int openByNames(int folder, const std::string& relative) {
    Descriptor at(::dup(folder));
    const fs::path path(relative);
    if (path.is_absolute() || path.empty()) {
        errno = EXDEV;
        return -1;
    }
    for (auto name = path.begin(); name != path.end(); ++name) {
        if (*name == ".") continue;
        if (*name == "..") {
            errno = EXDEV;
            return -1;
        }
        const bool is_last = std::next(name) == path.end();
        const int flags = is_last ? kReading | O_NOFOLLOW : O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
        const int next = ::openat(at.get(), name->c_str(), flags);
        if (next < 0 || is_last) return next;
        at.reset(next);
    }
    errno = EISDIR;
    return -1;
}

int descriptorBeneath(int folder, const std::string& relative) {
    struct open_how how {};
    how.flags = kReading;
    how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
    const long opened = ::syscall(SYS_openat2, folder, relative.c_str(), &how, sizeof how);
    if (opened >= 0) return static_cast<int>(opened);
    return errno == ENOSYS || errno == EPERM ? openByNames(folder, relative) : -1;
}

}  // namespace

InputFile openBeneath(const fs::path& folder, const std::string& relative) {
    const fs::path shown = folder / relative;
    const fs::path where = folder.empty() ? fs::path(".") : folder;
    const Descriptor at(::open(where.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (!at.isOpen()) throw InputError(where, "cannot open: " + std::generic_category().message(errno));
    if (relative.find('\0') != std::string::npos) throw InputError(shown, "is no name of a file");
    Descriptor file(descriptorBeneath(at.get(), relative));
    if (!file.isOpen() && errno == EXDEV)
        throw InputError(shown,
                         "leads out of the folder of the file that names it: only what is in there is read");
    return {shown, std::move(file)};
}

std::vector<unsigned char> readBeneath(const fs::path& folder, const std::string& relative,
                                       std::uint64_t limit) {
    const InputFile file = openBeneath(folder, relative);
    if (file.size() > limit)
        throw InputError(file.path(),
                         fmt::format("{} bytes is more than the {} that can be read", file.size(), limit));
    std::vector<unsigned char> bytes(static_cast<std::size_t>(file.size()));
    file.readAt(0, std::as_writable_bytes(std::span(bytes)));
    return bytes;
}

}  // namespace throng
