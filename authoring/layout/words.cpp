// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/words.h"

#include <fmt/format.h>

#include <algorithm>

namespace throng::authoring {
namespace {

/// Insertions, deletions and replacements between two words (Levenshtein 1966).
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
        }
    }
    return row[b.size()];
}

}  // namespace

std::string nearestWord(std::string_view word, const std::vector<std::string>& known) {
    constexpr std::size_t kLongest = 80;  // what is longer than a word has no nearest one
    std::string best;
    if (word.size() > kLongest) return best;
    std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string& candidate : known) {
        // By value: of two temporaries, std::minmax() would give references.
        const auto [shorter, longer] = std::minmax({word.size(), candidate.size()});
        if (longer - shorter >= least) continue;
        const std::size_t distance = editDistance(word, candidate);
        if (distance < least) {
            least = distance;
            best = candidate;
        }
    }
    return best;
}

std::string hintFor(std::string_view word, const std::vector<std::string>& known) {
    if (const std::string meant = nearestWord(word, known); !meant.empty())
        return fmt::format("did you mean `{}`?", meant);
    if (known.empty()) return "there are none";
    constexpr std::size_t kMostTold = 40;
    const bool all = known.size() <= kMostTold;
    const auto end = all ? known.end() : known.begin() + kMostTold;
    return fmt::format("known here: {}{}", fmt::join(known.begin(), end, ", "), all ? "" : ", ...");
}

}  // namespace throng::authoring
