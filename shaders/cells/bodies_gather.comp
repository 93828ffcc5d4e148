// SPDX-License-Identifier: Apache-2.0
// Orders the people of each cell by row, so that a bake repeats byte for byte, and gathers what neighbours read of
// each other into slot order: that memory locality is what makes sensing fast. For its sake the diagram that people
// sense with calls its sites by their slots; only pictures of it call them by their rows.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) readonly buffer RowCells { uint row_cells[]; };
layout(std430) readonly buffer LooseRows { uint loose_rows[]; };
layout(std430) writeonly buffer SiteSlots { uint site_slots[]; };
layout(std430) writeonly buffer Bodies { Body bodies[]; };
layout(std430) writeonly buffer Walkers { Walker walkers[]; };
layout(std430) writeonly buffer Sites { DiagramSite sites[]; };
uniform uint ids_are_rows;  // 0: slots

#include "shaders/cells/cell_starts.glsl"
#include "shaders/shared/charts.glsl"
#include "shaders/shared/images.glsl"
#ifdef BELTS
#include "shaders/shared/snap.glsl"
#include "shaders/charts/moving_ground.glsl"
#endif
#ifdef CHARTS
layout(std430) writeonly buffer SlotImages { SlotImage slot_images[]; };
layout(std430) writeonly buffer RowSlots { uint row_slots[]; };
#endif
#ifdef BODIES
layout(std430) readonly buffer Chests { Chest chests[]; };
#include "shaders/shared/body_shape.glsl"
#endif

void main() {
    uint loose = gl_GlobalInvocationID.x;
    if (loose >= live_count) return;
    uint site_row = loose_rows[loose];
    uint cell = row_cells[site_row];
    uint first = cellStart(cell);
    uint last = cellStart(cell + 1u);
    uint slot = first;
    for (uint other = first; other < last; ++other) slot += personOf(loose_rows[other]) < personOf(site_row) ? 1u : 0u;

    uint row = personOf(site_row);
    AgentState state = states[row];
    Person person = people[row];
    vec2 shift;
    imageShift(site_row, state.position, shift);
#ifdef CHARTS
    bool is_image = site_row != row;
    slot_images[slot] = SlotImage(shift, is_image ? row : NO_INDEX, 0u);
    if (!is_image) row_slots[row] = slot;
#endif
    Body body;
    body.position = state.position + shift;
    body.velocity = state.velocity;
#ifdef BELTS
    body.velocity += velocitySeenFrom(body.position, state.position);
#endif
    body.radius = person.radius;
    body.heading = state.heading;
    body.row = row;
    body.maximum_speed = person.maximum_speed;
    bodies[slot] = body;
    uint flags = person.flags;
#ifdef CHARTS
    if (is_image) flags |= WALKER_IS_IMAGE;
#endif
    Walker walker;
    walker.preferred_speed = person.preferred_speed;
    walker.flags = flags;
    walker.status = state.status;
    walker.stage = state.stage;
    walker.stage_end = state.stage_end;
    walker.leave_step = state.leave_step;
    walker.nervousness = state.nervousness;
    walker.way_through = 0u;
#ifdef HEADWAYS
    walker.headway = person.headway;
#endif
#ifdef PARTIES
    walker.party_first = person.party_first;
    walker.party_size = person.party_size;
#endif
#ifdef PLAN_CHANGES
    walker.change_count = person.change_count;
#endif
#ifdef WAITING_LINES
    walker.ticket = state.ticket;
#endif
#ifdef BODIES
    walker.half_axis = chests[row].half_axis;
    walker.chest = chests[row].angle;
    walker.chest_rate = chests[row].rate;
    vec2 axis = axisAt(walker.chest, walker.half_axis);
    walker.axis_x = axis.x;
    walker.axis_y = axis.y;
#endif
    walkers[slot] = walker;

    precise vec2 pixel = (body.position - parameters.diagram_minimum) * parameters.pixels_per_metre;
    DiagramSite site;
    site.position = pixel;
    site.radius = max(parameters.tile_radius, body.radius) * parameters.pixels_per_metre;
    site.id = ids_are_rows != 0u ? site_row : slot;
    sites[slot] = site;
    site_slots[site.id] = slot;
}
