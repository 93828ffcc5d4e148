// SPDX-License-Identifier: Apache-2.0
#include "cli/watch/file_watch.h"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace throng::cli {
namespace {

constexpr double kLooksEvery = 0.1;                // s
constexpr std::chrono::milliseconds kSettled{50};  // without a change
constexpr int kMostTries = 20;

}  // namespace

std::vector<FileWatch::Facts> FileWatch::look(const std::vector<std::filesystem::path>& files) {
    std::vector<Facts> facts;
    for (const std::filesystem::path& file : files) {
        struct stat found {};
        Facts& each = facts.emplace_back();
        if (::stat(file.c_str(), &found) != 0) continue;
        each = {true, found.st_ino, static_cast<std::uint64_t>(found.st_size),
                std::int64_t{found.st_mtim.tv_sec} * 1'000'000'000 + found.st_mtim.tv_nsec};
    }
    return facts;
}

void FileWatch::watch(std::vector<std::filesystem::path> files) {
    files_ = std::move(files);
    facts_ = look(files_);
    looked_ = Clock::now();
    changed_ = false;
}

void FileWatch::add(const std::vector<std::filesystem::path>& files) {
    const std::vector<Facts> facts = look(files);
    files_.insert(files_.end(), files.begin(), files.end());
    facts_.insert(facts_.end(), facts.begin(), facts.end());
}

bool FileWatch::hasChanged() {
    if (changed_ || secondsSince(looked_) < kLooksEvery) return changed_;
    looked_ = Clock::now();
    changed_ = look(files_) != facts_;
    return changed_;
}

void FileWatch::settle() const {
    std::vector<Facts> before = look(files_);
    for (int tries = 0; tries < kMostTries; ++tries) {
        std::this_thread::sleep_for(kSettled);
        std::vector<Facts> now = look(files_);
        // Editors that write a new file in the place of the old one leave none for a moment.
        if (now == before && std::ranges::all_of(now, &Facts::is_there)) return;
        before = std::move(now);
    }
}

}  // namespace throng::cli
