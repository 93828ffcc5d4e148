// SPDX-License-Identifier: Apache-2.0
// Bodies, their images beside seams and their tiles in the diagram are as large as sizes.comp has made people.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) buffer Bodies { Body bodies[]; };
layout(std430) writeonly buffer Sites { DiagramSite sites[]; };
#ifdef BODIES
layout(std430) buffer Walkers { Walker walkers[]; };
#include "shaders/shared/body_shape.glsl"
#endif

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count) return;
    Person person = people[bodies[slot].row];
    if (bodies[slot].radius == person.radius) return;
    bodies[slot].radius = person.radius;
    sites[slot].radius = max(parameters.tile_radius, person.radius) * parameters.pixels_per_metre;
#ifdef BODIES
    vec2 axis = axisAt(walkers[slot].chest, person.half_axis);
    walkers[slot].half_axis = person.half_axis;
    walkers[slot].axis_x = axis.x;
    walkers[slot].axis_y = axis.y;
#endif
}
