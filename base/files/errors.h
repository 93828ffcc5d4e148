// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "base/text/printable.h"

namespace throng {

/// Something could not be written. The message names the path and the system's reason.
class OutputError : public std::runtime_error {
  public:
    /// `action` reads after "cannot", e.g. "write"; `error_number` is an errno value.
    OutputError(const std::filesystem::path& path, const std::string& action, int error_number);
    /// For reasons that are not the system's, e.g. an existing bake.
    OutputError(const std::filesystem::path& path, const std::string& message);

    const std::filesystem::path& path() const { return path_; }
    /// The errno value, 0 when the reason is not the system's.
    int errorNumber() const { return error_number_; }

  private:
    std::filesystem::path path_;
    int error_number_ = 0;
};

/// Another process writes there.
class OutputBusy : public OutputError {
  public:
    using OutputError::OutputError;
};

/// A file of a bake could not be read or is not what it claims to be. The message begins with the path;
/// whatever of the file it repeats, it is short enough to be read.
class InputError : public std::runtime_error {
  public:
    InputError(const std::filesystem::path& path, const std::string& message)
        : std::runtime_error(path.string() + ": " + shortened(message)),
          path_(path),
          reason_(shortened(message)) {}

    const std::filesystem::path& path() const { return path_; }
    /// The message without the path.
    const std::string& reason() const { return reason_; }

  private:
    std::filesystem::path path_;
    std::string reason_;
};

}  // namespace throng
