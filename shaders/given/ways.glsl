// SPDX-License-Identifier: Apache-2.0
// Given ways: where somebody is at a time, straight from place to place.
// Needs shaders/shared/simulation_types.h and shaders/shared/snap.glsl.

layout(std430) readonly buffer GivenWays { GivenWay given_ways[]; };  // by row from `first_given` on
layout(std430) readonly buffer GivenPlaces { GivenPlace given_places[]; };
uniform uint first_given;

/// At home.
vec2 givenPlace(uint row, float time) {
    GivenWay way = given_ways[row - first_given];
    uint low = way.first_place, high = way.first_place + way.place_count - 1u;
    if (time <= given_places[low].time) return given_places[low].position;
    if (time >= given_places[high].time) return given_places[high].position;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (given_places[middle].time <= time)
            low = middle;
        else
            high = middle;
    }
    GivenPlace a = given_places[low], b = given_places[high];
    return mix(a.position, b.position, (time - a.time) / (b.time - a.time));
}

/// In the plane. @param rest of the person's state: the shift of the chart that it is on
vec2 inPlane(vec2 home, vec2 rest) {
#ifdef CHARTS
    return snapped(home) + rest;
#else
    return home;
#endif
}
