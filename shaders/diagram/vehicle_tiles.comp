// SPDX-License-Identifier: Apache-2.0
// Tiles that cover vehicles and what their cells may reach, for whoever places pages: they own no pixel.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) writeonly buffer VehicleTiles { DiagramSite vehicle_tiles[]; };
uniform uint tiles_per_vehicle;

#include "shaders/diagram/distance.glsl"
#include "shaders/diagram/vehicle_sites.glsl"

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= VEHICLES * tiles_per_vehicle) return;
    VehicleBox box = vehicle_boxes[index / tiles_per_vehicle];
    float along = float(index % tiles_per_vehicle) / float(max(tiles_per_vehicle, 2u) - 1u);
    DiagramSite tile = DiagramSite(vec2(-1.0e6), 0.0, NO_INDEX);
    if (box.half_width > 0.0) {
        vec2 rear = pixelsOf(box.rear), front = pixelsOf(box.front);
        float gap = length(front - rear) / float(max(tiles_per_vehicle, 2u) - 1u);
        tile.position = mix(rear, front, along);
        tile.radius = length(vec2(box.half_width * pixels_per_metre + vehicle_reach + 1.0, 0.5 * gap));
    }
    vehicle_tiles[index] = tile;
}
