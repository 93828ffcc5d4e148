// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "custom_json.h"
#include "parts.h"

namespace throng::fuzz {

inline const char* const kBakeFiles[] = {"bake.json",           "agents.csv",          "layout.json",
                                         "streams/pos.npy",     "streams/dir.npy",     "streams/state.npy",
                                         "streams/pos.pc2",     "streams/density.npy", "streams/wish.npy",
                                         "streams/ground.npy",  "streams/pos.packed",  "streams/dir.packed",
                                         "streams/state.packed"};

/// The folder of a bake in one input. bake.json has its keys from the seeds: there is no schema.
inline std::string mutatedBake(std::string_view input, std::size_t most, unsigned seed) {
    static const JsonMutator mutator{
        R"({"words": ["format", "throng bake", "version", "name", "complete", "fps", "frames",
        "agents", "origin", "bounds", "min", "max", "seed", "geometry", "roads", "areas", "walls", "id",
        "centreline",
        "width", "one_way", "polygon", "points", "closed", "thickness", "height", "gate",
        "open_at_start", "toggles",
        "ground", "account", "spawned", "walking", "arrived", "refused", "refused_reasons", "files",
        "path", "bytes",
        "xxh3", "streams", "pos", "dir", "state", "density", "wish", "terrain", "surface", "source",
        "lowest", "highest",
        "device", "renderer", "timing", "wall_seconds", "steps", "diagrams", "gltf", "variations",
        "substeps", "expect",
        "line", "throng", "flow"], "numbers": [1, 24, 1000, 4e9, 4294967295, 100000, 8, 6]})"};
    return mutatedPart(input, mutator, most, seed);
}

/// Puts the bake into the fuzzer's folder. @returns where it is
inline std::filesystem::path putBake(std::string_view input) {
    putParts(unpacked(input), "bake", kBakeFiles);
    return folder() / "bake";
}

}  // namespace throng::fuzz

#define THRONG_FUZZ_BAKE()                                                                                 \
    extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, \
                                                   unsigned seed) {                                        \
        return throng::fuzz::giveTo(                                                                       \
            data, most, throng::fuzz::mutatedBake(throng::fuzz::textOf(data, size), most, seed));          \
    }
