// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>

#include "base/files/errors.h"
#include "base/frame.h"
#include "recording/bake_description.h"

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

/// Writes the diagram of a layout with levels once more, a part a chart (a file of several parts:
/// OpenEXR 2.0).
///
/// Parts have the charts' names and the channels above, and `ground` UINT, 1 on the chart's own ground, and
/// `height` FLOAT, m, of that, 0 elsewhere. Each has a transform of its own, `throng:worldToPixel` and, in
/// single precision, the standard attribute `worldToNDC`; `throng:kind` (level, link, lift or ground),
/// `throng:level`, `throng:lowest` and `throng:highest` (m, of its ground), `throng:metresPerPixel`, and
/// `throng:chart`, its number. The display window is the whole site, seen from above; the first part's data
/// window is as large, and those of the others lie within it.
///
/// @param frame with the places of people, and their densities where it has any
void writeChartsExr(const std::filesystem::path& path, const DiagramImage& plane, const Frame& frame,
                    const recording::BakeDescription& bake);

}  // namespace throng::io
