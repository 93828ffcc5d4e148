// SPDX-License-Identifier: Apache-2.0
// Looks owners up in a diagram that is kept whole, or (with PAGED) page by page, see sim/diagram/pages.h, or (with
// BANDED) band by band, see sim/diagram/bands.h.
uniform usamplerBuffer owners;
#ifdef PAGED
uniform usamplerBuffer page_table;
#endif
#ifdef BANDED
uniform uint first_line;  // px, of the band
#endif
uniform uint owner_line;  // pixels in a line of the diagram; with PAGED, pages

uint ownerAt(uvec2 pixel) {
#ifdef PAGED
    uvec2 page = pixel / PAGE_SIDE;
    uvec2 within = pixel % PAGE_SIDE;
    uint place = texelFetch(page_table, int(page.y * owner_line + page.x)).r;
    return texelFetch(owners, int((place * PAGE_SIDE + within.y) * PAGE_SIDE + within.x)).r;
#else
#ifdef BANDED
    pixel.y -= first_line;
#endif
    return texelFetch(owners, int(pixel.y * owner_line + pixel.x)).r;
#endif
}
