// SPDX-License-Identifier: Apache-2.0
#include "base/stream_formats.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/tables.h"

namespace throng {
namespace {

static_assert(isInOrder(kStreamFormats), "kStreamFormats has a row for each form, in their order");

std::string_view trimmed(std::string_view word) {
    while (word.starts_with(' '))
        word.remove_prefix(1);
    while (word.ends_with(' '))
        word.remove_suffix(1);
    return word;
}

}  // namespace

StreamFormat StreamFormats::preferred() const {
    const auto found =
        std::ranges::find_if(kStreamFormats, [this](const StreamFormatInfo& info) { return has(info.id); });
    return found == kStreamFormats.end() ? kStreamFormats.front().id : found->id;
}

double StreamFormats::bytes() const {
    double sum = 0.0;
    for (const StreamFormatInfo& info : kStreamFormats)
        if (has(info.id)) sum += info.bytes;
    return sum;
}

std::string wordsOf(const StreamFormats& formats) {
    std::string words;
    for (const StreamFormatInfo& info : kStreamFormats)
        if (formats.has(info.id)) words.append(words.empty() ? "" : ",").append(info.name);
    return words;
}

std::string formatsInWords() {
    std::string words;
    for (const StreamFormatInfo& info : kStreamFormats)
        words += fmt::format("{}{} ({})", words.empty() ? "" : ", ", info.name, info.about);
    return words;
}

FormatsRead readFormats(std::string_view words) {
    FormatsRead read;
    for (std::size_t begin = 0; begin <= words.size();) {
        const std::size_t end = std::min(words.find(',', begin), words.size());
        const std::string_view word = trimmed(words.substr(begin, end - begin));
        begin = end + 1;
        const auto found = std::ranges::find(kStreamFormats, word, &StreamFormatInfo::name);
        if (found != kStreamFormats.end())
            read.formats.add(found->id);
        else if (read.problem.empty())
            read.problem =
                fmt::format("`{}` is no form of streams: a list with commas of {}", word, formatsInWords());
    }
    return read;
}

}  // namespace throng
