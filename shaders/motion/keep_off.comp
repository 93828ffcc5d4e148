// SPDX-License-Identifier: Apache-2.0
// Whatever people are pushed to: nobody ends a step in a vehicle, which does not give, and nobody who was not on a red
// crossing is on it after.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer TouchWords { uint touch_words[]; };
layout(std430) readonly buffer WallSegments { WallSegment wall_segments[]; };
layout(std430) readonly buffer WallStarts { uint wall_starts[]; };
layout(std430) readonly buffer WallItems { uint wall_items[]; };
layout(std430) buffer Targets { TARGET targets[]; };

#include "shaders/traffic/boxes.glsl"
layout(std430) readonly buffer Crossings { TrafficCrossing crossings[]; };
layout(std430) readonly buffer CrossingPoints { vec2 crossing_points[]; };
layout(std430) readonly buffer Lights { uint lights[]; };
#include "shaders/traffic/crossings.glsl"
#include "shaders/cells/cells.glsl"
#include "shaders/shared/walls.glsl"
#include "shaders/motion/out_of_walls.glsl"

vec2 outOfVehicles(vec2 place, float radius) {
    for (uint i = 0u; i < VEHICLES; ++i) {
        VehicleBox box = vehicle_boxes[i];
        if (box.half_width <= 0.0) continue;
        vec2 outward;
        float away = distanceToBox(place, box.rear, box.front, box.half_width, outward);
        if (away < radius) place += outward * (radius + HAIR_FROM_VEHICLES - away);
    }
    return place;
}

bool isOnRed(vec2 place) {
    for (uint i = 0u; i < CROSSINGS; ++i)
        if (isRed(crossings[i].light) && isOnCrossing(crossings[i], place)) return true;
    return false;
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count) return;
    Body self = bodies[slot];
    vec2 target = targets[slot].xy, place = target;
    if (isOnRed(place) && !isOnRed(self.position)) place = self.position;
    place = outOfVehicles(place, self.radius);
    if (place == target) return;
    if ((touch_words[slot] & TOUCH_WALL_NEAR) != 0u) place = keepOutOfWalls(self, place);
    targets[slot].xy = place;
}
