// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "sim/gl/shader_access.h"

namespace throng::gl {

/// What a program of a pass touches, as the C++ says it. A block that the program both reads and writes
/// stands in both lists; one that only some of the program's variants use stands there for all of them.
struct Declaration {
    std::string pass;                  ///< what it belongs to, as in messages and tables
    std::vector<std::string> shaders;  ///< paths, e.g. "shaders/sensing/sense.comp"
    std::vector<std::string> reads;    ///< storage and uniform blocks, samplers
    std::vector<std::string> writes;   ///< storage blocks

    bool readsFrom(const std::string& name) const;
    bool writesTo(const std::string& name) const;

    /// Compares with what the text of the program allows, and with what the driver found in use.
    /// @throws std::logic_error that names the pass and the block or sampler
    void check(const std::vector<Access>& allowed, const std::vector<std::string>& active) const;
};

}  // namespace throng::gl
