// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "authoring/layout.h"

namespace throng::authoring {

enum class Severity { error, warning };

/// One thing wrong with a layout, told so that its author can mend it.
struct Diagnostic {
    Severity severity = Severity::error;
    SourcePosition where;
    std::string message;  ///< what was found and what was expected
    std::string hint;     ///< how to mend it, e.g. "did you mean `width`?"; may be empty
};

/// All that was found in one file, in the order of the file. Of very many mistakes only the first are kept,
/// and whatever names from the file are in them can be shown on a terminal.
struct Diagnostics {
    static constexpr std::size_t kMost = 300;

    std::string file;
    std::vector<Diagnostic> entries;
    std::size_t left_out = 0;

    void error(const SourcePosition& where, std::string message, std::string hint = {});
    void warning(const SourcePosition& where, std::string message, std::string hint = {});
    /// Of another file, told within this one's.
    void add(Diagnostic entry);
    bool hasErrors() const { return has_errors_; }
    bool isFull() const { return entries.size() >= kMost; }

  private:
    bool has_errors_ = false;
};

}  // namespace throng::authoring
