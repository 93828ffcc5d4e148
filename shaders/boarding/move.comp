// SPDX-License-Identifier: Apache-2.0
// The leaves of doors move in every step, as evenly as pictures show them; what doors do next is decided where people
// decide (shaders/boarding/control.comp).
#include "shaders/shared/simulation_types.h"
#include "shaders/shared/traffic_types.h"
#include "shaders/shared/boarding_types.h"

layout(local_size_x = BOARDING_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) buffer VehicleServices { VehicleService services[]; };

void main() {
    for (uint vehicle = gl_LocalInvocationID.x; vehicle < VEHICLES; vehicle += BOARDING_GROUP_SIZE) {
        VehicleService service = services[vehicle];
        if (service.door_count == 0u) continue;
        service.since += parameters.step_seconds;
        service.stood += parameters.step_seconds;
        float share = clamp(service.since / service.door_time, 0.0, 1.0);
        if (service.phase == DOORS_OPEN_UP) service.open = share;
        if (service.phase == DOORS_CLOSE) service.open = 1.0 - share;
        services[vehicle] = service;
    }
}
