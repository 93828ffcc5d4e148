// SPDX-License-Identifier: Apache-2.0
// Vehicles as people meet them: boxes on the ground. Only with TRAFFIC.
#include "shaders/shared/traffic_types.h"

const float HAIR_FROM_VEHICLES = 0.005;  // m: what is left free between them and bodies

layout(std140) uniform VehicleBoxes { VehicleBox vehicle_boxes[MOST_VEHICLES]; };

/// m: from a box to a place, below 0 inside.
/// @param outward unit vector, from the nearest side
float distanceToBox(vec2 place, vec2 rear, vec2 front, float half_width, out vec2 outward) {
    vec2 axis = front - rear;
    float half_length = 0.5 * length(axis);
    vec2 along = axis / max(2.0 * half_length, 1.0e-6);
    vec2 aside = vec2(-along.y, along.x);
    vec2 offset = place - 0.5 * (rear + front);
    vec2 local = vec2(dot(offset, along), dot(offset, aside));
    vec2 way = vec2(local.x < 0.0 ? -1.0 : 1.0, local.y < 0.0 ? -1.0 : 1.0);
    vec2 beyond = abs(local) - vec2(half_length, half_width);
    vec2 outside = max(beyond, vec2(0.0));
    float size = length(outside);
    if (size > 0.0) {
        outward = (along * way.x * outside.x + aside * way.y * outside.y) / size;
        return size;
    }
    // Whoever is in it leaves by its side, unless its end is nearer.
    bool by_side = beyond.y >= beyond.x;
    outward = by_side ? aside * way.y : along * way.x;
    return by_side ? beyond.y : beyond.x;
}
