// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "harness.h"
#include "json_mutator.h"

namespace throng::fuzz {

/// Whatever has been made, where libFuzzer wants it.
inline std::size_t giveTo(std::uint8_t* data, std::size_t most, const std::string& made) {
    const std::size_t size = std::min(most, made.size());
    std::copy_n(made.begin(), size, data);
    return size;
}

inline std::string_view textOf(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

}  // namespace throng::fuzz

/// For a fuzzer whose inputs are JSON, with the schemas that its JsonMutator learns from.
#define THRONG_FUZZ_JSON(...)                                                                              \
    static const throng::fuzz::JsonMutator& ownMutator() {                                                 \
        static const throng::fuzz::JsonMutator made{__VA_ARGS__};                                          \
        return made;                                                                                       \
    }                                                                                                      \
    extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, \
                                                   unsigned seed) {                                        \
        using namespace throng::fuzz;                                                                      \
        return giveTo(data, most, ownMutator().mutate(textOf(data, size), most, seed));                    \
    }                                                                                                      \
    extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* one, std::size_t size,            \
                                                     const std::uint8_t* other, std::size_t other_size,    \
                                                     std::uint8_t* out, std::size_t most, unsigned seed) { \
        using namespace throng::fuzz;                                                                      \
        return giveTo(out, most,                                                                           \
                      ownMutator().cross(textOf(one, size), textOf(other, other_size), most, seed));       \
    }
