// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace throng::analysis {

/// A picture of a bake from above: the layout, who stands where and came from where, where it is crowded.
struct PreviewOptions {
    std::optional<std::uint32_t> frame;  ///< from 0; by default the one with most people
    int width = 1400;                    ///< px, [200, 8000]; the height follows from the layout
    int height = 0;  ///< px, about: layouts that would be higher are drawn narrower; 0: all are as wide
    double trail_seconds = 6.0;  ///< s, 0 = no trails
    bool density = true;         ///< persons per m^2 as a heat layer
    std::string level = {};      ///< only what is on this one; empty: all levels over each other
};

/// Draws one frame into a PNG. @throws InputError (the bake), OutputError (the picture)
/// @returns the frame drawn
std::uint32_t drawPreview(const std::filesystem::path& bake, const std::filesystem::path& png,
                          const PreviewOptions& options);

/// All frames as an MP4, by way of ffmpeg. @param progress called with the share done, 0 to 1
/// @throws InputError, OutputError; without ffmpeg the message names the package to install
void writePreviewVideo(const std::filesystem::path& bake, const std::filesystem::path& mp4,
                       const PreviewOptions& options, const std::function<void(double)>& progress);

}  // namespace throng::analysis
