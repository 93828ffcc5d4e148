// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// All that was found in one file, in the order of the file.
struct Diagnostics {
    std::string file;
    std::vector<Diagnostic> entries;

    void error(const SourcePosition& where, std::string message, std::string hint = {}) {
        entries.push_back({Severity::error, where, std::move(message), std::move(hint)});
    }
    void warning(const SourcePosition& where, std::string message, std::string hint = {}) {
        entries.push_back({Severity::warning, where, std::move(message), std::move(hint)});
    }
    bool hasErrors() const {
        for (const Diagnostic& entry : entries)
            if (entry.severity == Severity::error) return true;
        return false;
    }
};

}  // namespace throng::authoring
