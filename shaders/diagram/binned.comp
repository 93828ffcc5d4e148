// SPDX-License-Identifier: Apache-2.0
// The truncated Voronoi diagram by gathering: exact, without atomics, each pixel written once.
//
// Sites have been sorted into bins. An invocation keeps a block of pixels in registers and walks over the bins from
// which a tile can reach the block: every candidate is loaded once and offered to all pixels of the block, and most of
// the work is plain arithmetic on registers. Bins of one line are neighbours in memory, so a line of bins is one run of
// sites. The result does not depend on the order of the candidates: distance decides, then the smaller id.
//
// What it costs: blocks x candidates loads and pixels x candidates comparisons. Small blocks waste no comparisons,
// large ones save loads; small bins bring fewer candidates that cannot reach, but more lines to look up. The best sizes
// depend on the device and the density, and are chosen by measurement (sim/benchmarks/calibration.h).
//
// With PAGED, blocks are those of the pages in the list of this build (sim/diagram/pages.h); with LISTED, too, but the
// owners are one picture, and what lies outside the listed pages stays as it is. Of sites that never move, the diagram
// has been worked out before (FIXED_LAYERS), in the same way: with LAYERS, distances are kept beside the owners.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
#if defined(LAYERS)
layout(std430) writeonly buffer Layers { uvec2 layers[]; };  // the owner, and the squared distance to it as bits
#elif defined(STORE_BY_FOUR)
layout(std430) writeonly buffer Owners { uvec4 owners[]; };
#else
layout(std430) writeonly buffer Owners { uint owners[]; };
#endif
uniform usamplerBuffer binned_sites;  // a DiagramSite each, as bits
uniform float largest_radius;  // px
#if defined(PAGED) || defined(LISTED)
layout(std430) readonly buffer PageList { uint page_list[]; };
layout(std430) readonly buffer PageCount { uint page_groups[3]; uint page_count; };
#endif
#if defined(PAGED) || defined(LISTED) || defined(FIXED_LAYERS)
uniform uint pages_per_line;
#endif
#ifdef PAGED
uniform uint first_page;  // of the range of the store that is bound
#else
uniform uvec2 lines;         // px: the first that is kept, and one past the last
uniform uint diagram_width;  // px
#endif
#ifdef FIXED_LAYERS
layout(std430) readonly buffer FixedPlaces { uint fixed_places[]; };  // of squares of PAGE_SIDE px; 0: no fixed site
uniform usamplerBuffer fixed_layers;                                  // by place, as Layers
#endif

#include "shaders/diagram/bins.glsl"
#include "shaders/cells/cell_starts.glsl"  // bins are the cells, or stand in for them
#include "shaders/shared/flat_index.glsl"

const uint BLOCK_PIXELS = BLOCK_WIDTH * BLOCK_HEIGHT;
float nearest[BLOCK_PIXELS];
uint nearest_id[BLOCK_PIXELS];

/// Where this invocation's block is; false where there is none.
bool placeBlock(out uvec2 corner, out uint first_word, out uint words_per_line, out uint words_in_line) {
    uint block = flatIndex();
#if defined(PAGED) || defined(LISTED)
    const uint blocks_per_line = PAGE_SIDE / BLOCK_WIDTH;
    const uint blocks_per_page = blocks_per_line * (PAGE_SIDE / BLOCK_HEIGHT);
    uint page = block / blocks_per_page;
#ifdef PAGED
    page += first_page;
    if (page == 0u) return false;  // stays empty
#endif
    if (page >= page_count) return false;
    block %= blocks_per_page;
    uvec2 within = uvec2(block % blocks_per_line, block / blocks_per_line) * uvec2(BLOCK_WIDTH, BLOCK_HEIGHT);
    uint number = page_list[page];
    corner = uvec2(number % pages_per_line, number / pages_per_line) * PAGE_SIDE + within;
#endif
#ifdef PAGED
    first_word = (page - first_page) * PAGE_SIDE * PAGE_SIDE + within.y * PAGE_SIDE + within.x;
    words_per_line = PAGE_SIDE;
    words_in_line = 0xffffffffu;  // pages go on beyond the edge of the window
    return true;
#else
#ifndef LISTED
    uint blocks_per_line = (diagram_width + BLOCK_WIDTH - 1u) / BLOCK_WIDTH;
    corner = uvec2(block % blocks_per_line, block / blocks_per_line) * uvec2(BLOCK_WIDTH, BLOCK_HEIGHT);
    corner.y += lines.x;
#endif
    first_word = (corner.y - lines.x) * diagram_width + corner.x;
    words_per_line = diagram_width;
    words_in_line = diagram_width;
    return corner.y >= lines.x && corner.y < lines.y;
#endif
}

/// The same arithmetic as distance.glsl, with the square of each line and column taken once.
void offer(vec2 corner, uvec4 words) {
    vec3 site = uintBitsToFloat(words.xyz);
    uint id = words.w;
    precise float limit = site.z * site.z;
    precise float across[BLOCK_WIDTH];
    for (uint x = 0u; x < BLOCK_WIDTH; ++x) {
        precise float offset = site.x - (corner.x + float(x) + 0.5);
        across[x] = offset * offset;
    }
    for (uint y = 0u; y < BLOCK_HEIGHT; ++y) {
        precise float offset = site.y - (corner.y + float(y) + 0.5);
        precise float up = offset * offset;
        for (uint x = 0u; x < BLOCK_WIDTH; ++x) {
            uint pixel = y * BLOCK_WIDTH + x;
            precise float squared = across[x] + up;
            bool wins = squared < nearest[pixel] || (squared == nearest[pixel] && id < nearest_id[pixel]);
            wins = wins && squared <= limit;
            nearest[pixel] = wins ? squared : nearest[pixel];
            nearest_id[pixel] = wins ? id : nearest_id[pixel];
        }
    }
}

#ifdef FIXED_LAYERS
/// Once all that move have been offered. Ids of fixed sites are above all others: they lose ties.
void offerFixed(uvec2 corner) {
    uvec2 square = corner / PAGE_SIDE, within = corner % PAGE_SIDE;
    uint place = fixed_places[square.y * pages_per_line + square.x];
    uint first = (place * PAGE_SIDE + within.y) * PAGE_SIDE + within.x;
    for (uint y = 0u; y < BLOCK_HEIGHT; ++y)
        for (uint x = 0u; x < BLOCK_WIDTH; ++x) {
            uvec2 fixed_site = texelFetch(fixed_layers, int(first + y * PAGE_SIDE + x)).xy;
            uint pixel = y * BLOCK_WIDTH + x;
            // Where there is none, the distance is not below any.
            bool wins = uintBitsToFloat(fixed_site.y) < nearest[pixel];
            nearest_id[pixel] = wins ? fixed_site.x : nearest_id[pixel];
        }
}
#endif

void main() {
    uvec2 block_corner;
    uint first_word, words_per_line, words_in_line;
    if (!placeBlock(block_corner, first_word, words_per_line, words_in_line)) return;
    vec2 corner = vec2(block_corner);
    for (uint pixel = 0u; pixel < BLOCK_PIXELS; ++pixel) {
        nearest[pixel] = 3.0e38;
        nearest_id[pixel] = NO_INDEX;
    }

    // A little more than the largest tile makes up for rounding.
    float reach = largest_radius + 0.01;
    uvec2 lower = binOf(corner - reach);
    uvec2 upper = binOf(corner + vec2(BLOCK_WIDTH, BLOCK_HEIGHT) + reach);
    for (uint line = lower.y; line <= upper.y; ++line) {
        uint bins = line * uint(bin_count.x);
        uint first = cellStart(bins + lower.x);
        uint last = cellStart(bins + upper.x + 1u);
        for (uint i = first; i < last; ++i) offer(corner, texelFetch(binned_sites, int(i)));
    }
#ifdef FIXED_LAYERS
    offerFixed(block_corner);
#endif

    for (uint y = 0u; y < BLOCK_HEIGHT; ++y) {
#ifndef PAGED
        if (block_corner.y + y >= lines.y) break;
#endif
        uint word = first_word + y * words_per_line;
        uint pixel = y * BLOCK_WIDTH;
#if defined(LAYERS)
        for (uint x = 0u; x < BLOCK_WIDTH; ++x)
            layers[word + x] = uvec2(nearest_id[pixel + x], floatBitsToUint(nearest[pixel + x]));
#elif defined(STORE_BY_FOUR)
        for (uint x = 0u; x < BLOCK_WIDTH; x += 4u) {
            if (block_corner.x + x >= words_in_line) break;
            uint i = pixel + x;
            owners[(word + x) / 4u] =
                uvec4(nearest_id[i], nearest_id[i + 1u], nearest_id[i + 2u], nearest_id[i + 3u]);
        }
#else
        for (uint x = 0u; x < BLOCK_WIDTH; ++x)
            if (block_corner.x + x < words_in_line) owners[word + x] = nearest_id[pixel + x];
#endif
    }
}
