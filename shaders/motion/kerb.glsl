// SPDX-License-Identifier: Apache-2.0
// The kerb, for those who keep to roads: like a wall's face, along the gradient of the distance to the roads' edge, but
// it gives way where walls leave no other way. Those pushed off the road come back at a stroll: nothing hard is there.
// Needs the blocks ParametersBlock and RoadDistances, and shaders/motion/linear_program.glsl.

#ifdef ROADS
float roadDistance(uvec2 cell) { return road_distances[cell.y * parameters.grid_width + cell.x]; }

bool kerbConstraint(Body self, out vec3 constraint) {
    vec2 size = vec2(parameters.grid_width, parameters.grid_height);
    vec2 at = clamp((self.position - parameters.grid_minimum) / parameters.grid_cell - 0.5, vec2(0.0), size - 1.001);
    uvec2 cell = uvec2(at);
    vec2 f = at - vec2(cell);
    float d00 = roadDistance(cell), d10 = roadDistance(cell + uvec2(1u, 0u));
    float d01 = roadDistance(cell + uvec2(0u, 1u)), d11 = roadDistance(cell + uvec2(1u, 1u));
    float inside = mix(mix(d00, d10, f.x), mix(d01, d11, f.x), f.y);
    vec2 gradient = vec2(mix(d10 - d00, d11 - d01, f.y), mix(d01 - d00, d11 - d10, f.x));
    float slope = length(gradient);
    if (inside > KERB_REACH || slope < 1.0e-6) return false;
    float gap = inside - self.radius;
    constraint = vec3(gradient / slope, min(-gap / KERB_HORIZON, KERB_RETURN_SPEED));
    return true;
}

/// Sets the kerb's constraint as number `index`. @returns how many it has set: 1, or 0 where there is none
int kerbBeside(Body self, Walker walker, int index) {
    vec3 kerb;
    bool keeps = KERB_ENABLED && (walker.flags & PERSON_KEEPS_TO_ROADS) != 0u;
    if (!keeps || !kerbConstraint(self, kerb)) return 0;
    setConstraint(index, kerb);
    return 1;
}
#else
int kerbBeside(Body self, Walker walker, int index) { return 0; }
#endif
