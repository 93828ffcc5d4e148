// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "authoring/layout/layout_reader.h"
#include "base/text/printable.h"

namespace throng::authoring {
namespace {

constexpr std::size_t kWidest = 110;  // columns of source shown

std::string_view lineOf(std::string_view text, int line) {
    std::size_t from = 0;
    for (int i = 1; i < line; ++i) {
        from = text.find('\n', from);
        if (from == std::string_view::npos) return {};
        ++from;
    }
    std::string_view found = text.substr(from, text.find('\n', from) - from);
    while (!found.empty() && found.back() == '\r')
        found.remove_suffix(1);
    return found;
}

}  // namespace

std::string formatDiagnostic(const Diagnostic& diagnostic, std::string_view file, std::string_view text) {
    const SourcePosition& where = diagnostic.where;
    const char* severity = diagnostic.severity == Severity::error ? "error" : "warning";
    const std::string name = printable(file);
    std::string result = where.line > 0
                             ? fmt::format("{}:{}:{}: {}: ", name, where.line, where.column, severity)
                             : fmt::format("{}: {}: ", name, severity);
    // Only values that came from the command line have a pointer and no line.
    const std::string pointer = where.pointer();
    if (where.line == 0 && pointer.starts_with('/')) result += "--set ";
    if (!pointer.empty()) result += shortened(printable(pointer)) + ": ";
    result += diagnostic.message;
    if (where.line > 0) {
        const std::string_view line = lineOf(text, where.line);
        if (!line.empty() && line.size() <= kWidest) {
            std::string caret;
            int column = 1;
            for (const char byte : line) {
                if (column >= where.column) break;
                if ((static_cast<unsigned char>(byte) & 0xc0u) == 0x80u) continue;
                caret += byte == '\t' ? '\t' : ' ';
                ++column;
            }
            result += fmt::format("\n  {}\n  {}^", printable(line, true), caret);
        }
    }
    if (!diagnostic.hint.empty()) result += fmt::format("\n  hint: {}", diagnostic.hint);
    return result;
}

}  // namespace throng::authoring
