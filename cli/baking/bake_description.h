// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "base/frame.h"
#include "cli/baking/load_layout.h"
#include "recording/bake_description.h"
#include "sim/gl/context.h"

namespace throng::cli {

struct BakeOptions {
    std::string output;
    bool force = false;
    bool gltf = true;
    std::uint32_t gltf_agents = 2000;
    StreamFormats formats = StreamFormats::standard();  ///< in which streams are written
};

/// The folder of a bake. Without -o it has the layout's name, if that is the name of a folder here and leads
/// nowhere else. @throws InputError
std::string outputOf(const LoadedLayout& loaded, const BakeOptions& options);

/// How many frames a bake of it has.
std::uint32_t framesOf(const authoring::SimulationSettings& settings);

/// All that the writers have to know of a layout and its scene.
recording::BakeDescription describeBake(const LoadedLayout& loaded, const BakeOptions& options,
                                        const gl::Device& device);

/// What pictures of its charts have to say, where it has any.
void describePictures(const LoadedLayout& loaded, recording::BakeDescription& bake);

/// Asks for the stream without which nobody knows where the shoulders of people with bodies are.
void askForBodies(recording::BakeDescription& bake);

/// How many people were refused for each reason.
std::map<std::string, std::uint32_t> refusals(const Account& account);

}  // namespace throng::cli
