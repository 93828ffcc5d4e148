// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

/// What all randomness is made of. (That of the shaders is in shaders/shared/random.glsl: words of 32 bits.)
namespace throng {

/// SplitMix64's finaliser (Steele, Lea and Flood 2014).
inline std::uint64_t scramble(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15ull;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

/// In [0, 1), of a random word.
inline double fractionOf(std::uint64_t word) {
    return static_cast<double>(word >> 11) * 0x1.0p-53;
}

/// FNV-1a.
inline std::uint64_t wordOf(std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325ull;
    for (const char letter : text)
        hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3ull;
    return hash;
}

}  // namespace throng
