// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>

#include "base/files/errors.h"
#include "base/frame.h"

namespace throng::io {

/// Writes one diagram as OpenEXR (lossless, scan lines, ZIP). The top row of the image has the highest y.
///
/// Channels: `id` UINT (row of the person, number of the wall tile, or 4294967295), `kind` UINT (0 none, 1
/// person, 2 wall), `distance` FLOAT in metres (-1 where there is no owner); `R`, `G`, `B`, `A` HALF, what
/// any program shows of it: a colour for each person, linear and darker away from them, A = 1 in people's
/// cells and 0 elsewhere. Where the image has them, `second` and `secondKind` UINT, likewise for the
/// second-nearest site. With densities (three values a person, the first of them persons per square metre),
/// `density` FLOAT: the owner's, 0 where that is no person. Header: `throng:worldToPixel` (M33d, for row
/// vectors [x y 1] in world coordinates), `throng:minimum` (V2d, world, the lower left corner of the image),
/// `throng:pixelsPerMetre`, `throng:frame` (the scene's frame, index + 1), `framesPerSecond`.
///
/// `scene_origin` is what takes the image's frame of reference to the world, in metres. No state is shared:
/// any thread may call it. Throws OutputError.
void writeDiagramExr(const std::filesystem::path& path, const DiagramImage& image,
                     std::span<const float> densities, glm::dvec2 scene_origin, std::uint32_t frame_index,
                     double fps);

}  // namespace throng::io
