// SPDX-License-Identifier: Apache-2.0
#include "authoring/diagnostics.h"

#include <utility>

#include "base/text/printable.h"

namespace throng::authoring {

void Diagnostics::error(const SourcePosition& where, std::string message, std::string hint) {
    add({Severity::error, where, shortened(printable(message)), shortened(printable(hint))});
}

void Diagnostics::warning(const SourcePosition& where, std::string message, std::string hint) {
    add({Severity::warning, where, shortened(printable(message)), shortened(printable(hint))});
}

void Diagnostics::add(Diagnostic entry) {
    const bool is_error = entry.severity == Severity::error;
    if (!isFull()) {
        entries.push_back(std::move(entry));
    } else {
        if (is_error && !has_errors_) entries.back() = std::move(entry);  // what makes a file wrong is told
        ++left_out;
    }
    has_errors_ = has_errors_ || is_error;
}

}  // namespace throng::authoring
