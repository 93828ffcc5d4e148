// SPDX-License-Identifier: Apache-2.0
#include "io/bake_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <set>
#include <system_error>
#include <utility>

#include "base/files/output_file.h"
#include "io/checkpoint.h"
#include "io/door_file.h"
#include "io/lift_file.h"
#include "io/under_way.h"
#include "io/vehicle_file.h"

namespace throng::io {
namespace fs = std::filesystem;
namespace {

constexpr int kAttempts = 100;

std::string randomSuffix() {
    std::random_device device;
    std::string suffix;
    for (int i = 0; i < 6; ++i)
        suffix += "abcdefghijklmnopqrstuvwxyz0123456789"[device() % 36];
    return suffix;
}

/// Creates `BASE.tmp-XXXXXX` with the permissions that the user's umask gives to new folders.
fs::path createTemporary(const fs::path& base) {
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        fs::path path = base.string() + ".tmp-" + randomSuffix();
        if (::mkdir(path.c_str(), 0777) == 0) return path;
        if (errno != EEXIST) throw OutputError(path, "create", errno);
    }
    throw OutputError(base, "create a temporary folder beside", EEXIST);
}

/// `--force` must not be able to remove somebody's home because of a slip of the keyboard.
void requireReplaceable(const fs::path& path) {
    const fs::file_status status = fs::symlink_status(path);
    if (!fs::is_directory(status))
        throw OutputError(path, "exists and is not a folder; it will not be replaced");
    if (!fs::is_empty(path) && !fs::exists(path / "bake.json"))
        throw OutputError(path, "exists and is not a bake (no bake.json inside); it will not be replaced");
}

/// A folder that happens to have the name of an unfinished bake must not be emptied.
void requireOurs(const fs::path& folder) {
    const std::set<std::string> ours = {"streams",     "diagrams",  "layout.json", "agents.csv", "crowd.glb",
                                        "terrain.glb", "bake.json", kVehicleFile,  kDoorFile,    kLiftFile};
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const bool tells_of_it = name.starts_with(kUnderWayFile);  // or began to, and was killed
        if (!ours.contains(name) && !tells_of_it && !isCheckpoint(entry.path()))
            throw OutputError(folder, "is there and has something else than a bake in it (" + name +
                                          "); it will not be touched");
    }
}

bool isTaken(const fs::path& path) {
    return fs::exists(fs::symlink_status(path));
}

/// Puts `fresh` in the place of `old` and returns where the old one is now.
fs::path exchange(const fs::path& fresh, const fs::path& old) {
    if (::renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, old.c_str(), RENAME_EXCHANGE) == 0) return fresh;
    if (errno != EINVAL && errno != ENOSYS) throw OutputError(old, "replace", errno);
    fs::path aside = old.string() + ".old-" + randomSuffix();
    if (::rename(old.c_str(), aside.c_str()) != 0) throw OutputError(old, "move aside", errno);
    if (::rename(fresh.c_str(), old.c_str()) != 0) {
        const int reason = errno;
        if (::rename(aside.c_str(), old.c_str()) != 0) throw OutputError(aside, "move back", errno);
        throw OutputError(old, "replace", reason);
    }
    return aside;
}

fs::path withoutTrailingSlash(const fs::path& path) {
    const fs::path normal = path.lexically_normal();
    return normal.has_filename() ? normal : normal.parent_path();
}

fs::path parentOf(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

}  // namespace

void BakeFolder::prepare(const fs::path& final_path) {
    if (!final_.has_filename() || final_.filename() == "." || final_.filename() == "..")
        throw OutputError(final_path, "is no name for a bake");
    try {
        if (isTaken(final_)) {
            if (!force_) throw OutputError(final_, "exists; give another name, or --force to replace it");
            requireReplaceable(final_);
        }
        fs::create_directories(parentOf(final_));
    } catch (const fs::filesystem_error& error) {
        throw OutputError(final_, "create", error.code().value());
    }
}

BakeFolder::BakeFolder(const fs::path& final_path, bool force)
    : final_(withoutTrailingSlash(final_path)), force_(force) {
    prepare(final_path);
    temporary_ = createTemporary(final_);
}

BakeFolder::BakeFolder(const fs::path& final_path, bool force, Begun begun)
    : final_(withoutTrailingSlash(final_path)), force_(force) {
    prepare(final_path);
    temporary_ = unfinishedPath(final_path);
    // Whoever had it before may just have given it its final name: then the lock is on another folder.
    for (int attempt = 0; !hasLock(); ++attempt) {
        if (attempt == kAttempts) throw OutputError(temporary_, "is renamed by others again and again");
        if (::mkdir(temporary_.c_str(), 0777) != 0 && errno != EEXIST)
            throw OutputError(temporary_, "create", errno);
        lock();
    }
    if (begun == Begun::go_on) {
        committed_ = true;  // there is a checkpoint: nothing may be lost
        return;
    }
    requireOurs(temporary_);
    std::error_code error;
    for (fs::directory_iterator it(temporary_, error), end; !error && it != end; it.increment(error))
        fs::remove_all(it->path(), error);
    if (error) throw OutputError(temporary_, "empty", error.value());
}

fs::path BakeFolder::unfinishedPath(const fs::path& final_path) {
    return withoutTrailingSlash(final_path).string() + ".unfinished";
}

/// Whether the folder that is locked is the one of that name.
bool BakeFolder::hasLock() const {
    struct stat locked {
    }, named{};
    return lock_ >= 0 && ::fstat(lock_, &locked) == 0 && ::stat(temporary_.c_str(), &named) == 0 &&
           locked.st_dev == named.st_dev && locked.st_ino == named.st_ino;
}

void BakeFolder::lock() {
    if (lock_ >= 0) ::close(std::exchange(lock_, -1));
    lock_ = ::open(temporary_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ < 0 && errno == ENOENT) return;
    if (lock_ < 0) throw OutputError(temporary_, "open", errno);
    // Where a file system knows no locks, people have to look out for themselves.
    if (::flock(lock_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
    ::close(std::exchange(lock_, -1));
    throw OutputBusy(temporary_, "another process is at work in it");
}

BakeFolder::~BakeFolder() {
    std::error_code ignored;
    if (!committed_) fs::remove_all(temporary_, ignored);
    if (lock_ >= 0) ::close(lock_);
}

fs::path BakeFolder::addFolder(const fs::path& name) {
    fs::path path = temporary_ / name;
    if (::mkdir(path.c_str(), 0777) != 0) throw OutputError(path, "create", errno);
    return path;
}

void BakeFolder::syncAll() const {
    std::error_code error;
    for (fs::recursive_directory_iterator it(temporary_, error), end; !error && it != end;
         it.increment(error))
        if (it->is_directory(error)) syncFolder(it->path());
    if (error) throw OutputError(temporary_, "list", error.value());
    syncFolder(temporary_);
}

fs::path BakeFolder::commit() {
    syncAll();
    if (!renameNoReplace(temporary_, final_)) {
        if (!force_) throw OutputError(final_, "came into being during the bake; it will not be replaced");
        requireReplaceable(final_);
        const fs::path old = exchange(temporary_, final_);
        forget();
        std::error_code error;
        fs::remove_all(old, error);
        if (error) throw OutputError(old, "remove the replaced bake", error.value());
    }
    forget();
    syncFolder(parentOf(final_));
    return final_;
}

fs::path BakeFolder::commitPartial() {
    syncAll();
    for (int attempt = 1; attempt <= kAttempts; ++attempt) {
        fs::path partial = final_.string() + ".partial" + (attempt > 1 ? fmt::format("-{}", attempt) : "");
        if (!renameNoReplace(temporary_, partial)) continue;
        forget();
        syncFolder(parentOf(final_));
        return partial;
    }
    throw OutputError(final_.string() + ".partial", "exists, and so do many others like it");
}

}  // namespace throng::io
