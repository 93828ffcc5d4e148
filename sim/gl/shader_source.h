// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace throng::gl {

class ProgramPool;

using Definitions = std::vector<std::pair<std::string, std::string>>;

/// Where shaders come from: embedded in the binary, or a folder that takes their place for live editing.
class ShaderLibrary {
  public:
    ShaderLibrary() = default;
    /// @param folder a copy of the project's shaders/ folder; files that it lacks come from the binary, all
    /// of them where it is empty
    explicit ShaderLibrary(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// The complete GLSL of one shader: version line, definitions, and its includes put in place, each once.
    /// Definitions that it does not mention are left out, so that scenes that differ in them share its
    /// program.
    /// @param path e.g. "shaders/sensing/sense.comp"
    /// @param files receives the names behind the #line numbers of compiler messages
    /// @throws GraphicsError for a missing file
    std::string load(const std::string& path, const Definitions& definitions,
                     std::vector<std::string>& files) const;

    /// From here on, programs made from this library and its copies are kept when nobody needs them any more,
    /// and handed to whoever asks for the same. Needs a context that outlives them all.
    void keepPrograms();
    const std::shared_ptr<ProgramPool>& pool() const { return pool_; }

  private:
    std::string readFile(const std::string& path) const;
    void append(const std::string& path, std::vector<std::string>& files, std::string& out) const;

    std::filesystem::path folder_;
    std::shared_ptr<ProgramPool> pool_;  // none: programs are compiled each time
};

}  // namespace throng::gl
