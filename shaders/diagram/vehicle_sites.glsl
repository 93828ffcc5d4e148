// SPDX-License-Identifier: Apache-2.0
// Vehicles as sites of the diagram. Only with TRAFFIC; needs shaders/diagram/distance.glsl.
#include "shaders/traffic/boxes.glsl"

uniform uint first_vehicle;     // of the sites' ids: those after the walls'
uniform float vehicle_reach;    // px, as a wall's tile
uniform vec2 diagram_minimum;   // m: the corner of pixel (0, 0)
uniform float pixels_per_metre;

vec2 pixelsOf(vec2 place) { return (place - diagram_minimum) * pixels_per_metre; }

/// px^2, from a pixel's centre; 0 in the vehicle.
float squaredDistanceToVehicle(uint vehicle, ivec2 pixel) {
    VehicleBox box = vehicle_boxes[vehicle];
    vec2 outward;
    float away = distanceToBox(vec2(pixel) + 0.5, pixelsOf(box.rear), pixelsOf(box.front),
                               box.half_width * pixels_per_metre, outward);
    return squaredRadius(max(away, 0.0));
}
