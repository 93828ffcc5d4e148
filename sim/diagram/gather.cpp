// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/gather.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace throng::sim {
namespace {

gl::Declaration declarationOf(Gathering gathering) {
    return {"diagram",
            {"shaders/diagram/binned.comp"},
            {"binned_sites", "StripStarts", "CellOffsets", "FixedPlaces", "fixed_layers", "PageList",
             "PageCount"},
            {gathering == Gathering::layers ? "Layers" : "Owners"}};
}

}  // namespace

gl::ComputeProgram gatherProgram(const gl::ShaderLibrary& library, const DiagramOptions& options,
                                 Gathering gathering, bool fixed_layers) {
    const bool paged = gathering == Gathering::pages || gathering == Gathering::layers;
    gl::Definitions definitions = {{"BLOCK_WIDTH", fmt::format("{}u", options.gather.block_width)},
                                   {"BLOCK_HEIGHT", fmt::format("{}u", options.gather.block_height)}};
    if (fixed_layers) definitions.emplace_back("FIXED_LAYERS", "1");
    if (paged) definitions.emplace_back("PAGED", "1");
    if (gathering == Gathering::near_people) definitions.emplace_back("LISTED", "1");
    if (gathering == Gathering::layers) definitions.emplace_back("LAYERS", "1");
    const bool lines_of_fours = paged || options.width % 4 == 0;
    if (lines_of_fours && options.gather.block_width % 4 == 0) definitions.emplace_back("STORE_BY_FOUR", "1");
    return gl::ComputeProgram(library, declarationOf(gathering), definitions);
}

gl::Buffer noStrips(const BinGrid& grid) {
    return gl::makeBuffer("no strips", std::vector<std::uint32_t>(grid.count() / gpu::CELLS_PER_STRIP + 1),
                          "strip");
}

std::uint64_t blocksAcross(std::uint32_t pixels, std::uint32_t block) {
    return (pixels + block - 1) / block;
}

std::uint32_t blocksPerPage(const GatherShape& shape) {
    return (gpu::PAGE_SIDE / shape.block_width) * (gpu::PAGE_SIDE / shape.block_height);
}

std::uint32_t pagesPerRange(const GatherShape& shape, std::size_t bytes_of_page) {
    GLint64 bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    const auto by_memory = static_cast<std::uint64_t>(bytes) / bytes_of_page;
    const std::uint64_t by_groups = std::uint64_t{65535} * gpu::PIXEL_GROUP_SIZE / blocksPerPage(shape);
    return static_cast<std::uint32_t>(std::min(by_memory, by_groups));
}

}  // namespace throng::sim
