// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/stopwatch.h"

namespace throng::cli {

/// Notices when files change, come or go: by their times, sizes and identities, which every file system has,
/// ten times a second.
class FileWatch {
  public:
    /// From here on these, as they are now.
    void watch(std::vector<std::filesystem::path> files);
    /// These as well.
    void add(const std::vector<std::filesystem::path>& files);
    /// Whether one of them is not as it was. Looks at most every tenth of a second, and may be asked as often
    /// as one likes.
    bool hasChanged();
    /// Waits until nobody writes them any more: what is half written is no mistake.
    void settle() const;

  private:
    struct Facts {
        bool is_there = false;
        std::uint64_t inode = 0, bytes = 0;
        std::int64_t nanoseconds = 0;
        bool operator==(const Facts&) const = default;
    };
    static std::vector<Facts> look(const std::vector<std::filesystem::path>& files);

    std::vector<std::filesystem::path> files_;
    std::vector<Facts> facts_;
    Clock::time_point looked_{};
    bool changed_ = false;
};

}  // namespace throng::cli
