// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "base/files/errors.h"

namespace throng::io {

/// A folder that appears under its name only when it is complete.
///
/// Everything is written into `NAME.tmp-XXXXXX` beside it; commit() gives it its name in one step. A folder
/// that was never committed is removed by the destructor. All members throw OutputError.
class BakeFolder {
  public:
    /// Creates the temporary folder (and the parents of `final_path`). An error before any work when
    /// `final_path` exists, unless `force`; and even then when what exists is neither a bake nor an empty
    /// folder.
    BakeFolder(const std::filesystem::path& final_path, bool force);
    /// The same for bakes that may be stopped and go on later: everything goes into `NAME.unfinished`, which
    /// is locked while somebody works in it, and kept when there is a checkpoint in it.
    enum class Begun { begin, go_on };
    BakeFolder(const std::filesystem::path& final_path, bool force, Begun begun);
    static std::filesystem::path unfinishedPath(const std::filesystem::path& final_path);
    BakeFolder(const BakeFolder&) = delete;
    BakeFolder& operator=(const BakeFolder&) = delete;
    ~BakeFolder();

    /// Where the files go until then.
    const std::filesystem::path& path() const { return temporary_; }
    /// Creates a folder inside.
    std::filesystem::path addFolder(const std::filesystem::path& name);

    /// Makes all durable and gives the folder its name, replacing an existing bake with `force`. Returns the
    /// path.
    std::filesystem::path commit();
    /// The same under the name `NAME.partial`, or `NAME.partial-2` and so on: nothing is ever replaced.
    std::filesystem::path commitPartial();

    /// From here on, the folder stays whatever happens: somebody will go on with it.
    void keep() { committed_ = true; }

  private:
    void prepare(const std::filesystem::path& final_path);
    bool hasLock() const;
    void lock();
    void syncAll() const;
    void forget() { committed_ = true; }

    std::filesystem::path final_;
    std::filesystem::path temporary_;
    int lock_ = -1;  // a file descriptor
    bool force_ = false;
    bool committed_ = false;
};

}  // namespace throng::io
