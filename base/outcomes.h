// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

/// What became of people, in words: the account of a bake, its table, measurements, batches and the
/// Blender add-on all mean this by them (docs/bake.md has the same table, and a test compares the two).
namespace throng {

enum class Fate { spawned, walking, waiting, arrived, seated, stuck, refused };

struct FateWord {
    Fate fate;
    std::string_view word;
    std::string_view meaning;
};

inline constexpr std::array kFates = {
    FateWord{Fate::spawned, "spawned", "Came into the scene: everybody who is walking or arrived."},
    FateWord{Fate::walking, "walking",
             "In the scene at the end and not arrived, also who stands at a stop or in a line."},
    FateWord{Fate::waiting, "waiting", "Not yet in the scene; who still waits when a bake ends is refused."},
    FateWord{Fate::arrived, "arrived", "Came to its goal, and left there or stayed."},
    FateWord{Fate::seated, "seated", "Has a seat, and sits in it or stands before it; arrived, too."},
    FateWord{
        Fate::stuck, "stuck",
        "Walking at the end, for five seconds at no stop and in no line, and not half a metre on in them."},
    FateWord{Fate::refused, "refused", "Never came into the scene; the reason is told."},
};

constexpr std::string_view wordFor(Fate fate) {
    return kFates[static_cast<std::size_t>(fate)].word;
}
static_assert([] {
    for (std::size_t i = 0; i < kFates.size(); ++i)
        if (kFates[i].fate != static_cast<Fate>(i)) return false;
    return kFates.size() == static_cast<std::size_t>(Fate::refused) + 1;
}());

/// The same as a key of JSON.
inline std::string keyFor(Fate fate) {
    return std::string(wordFor(fate));
}

inline constexpr double kStuckSeconds = 5.0;  ///< the last of a bake
inline constexpr double kStuckMetres = 0.5;

}  // namespace throng
