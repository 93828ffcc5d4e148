// SPDX-License-Identifier: Apache-2.0
// Room by time to collision. People do not react to how near somebody is but to how soon they would collide: from
// trajectories of real pedestrians, the energy of a pair that would touch in t seconds is k / t^2 exp(-t / t0)
// (Karamouzas, Skinner and Guy 2014, equations 3 and 4). Its downhill gradient is an acceleration that points across
// the relative velocity while there is time, and back along it when there is none: people go round each other first,
// and brake last.
// Needs the block ParametersBlock and shaders/shared/at_most.glsl.

/// Seconds until two discs touch, or -1 where they do not.
/// @param offset from the other to oneself, m
/// @param relative one's own velocity less the other's, m/s
/// @param root receives the square root in the solution, which the gradient needs too
float timeToCollision(vec2 offset, vec2 relative, float reach, out float root) {
    float speed_squared = dot(relative, relative);
    float closing = -dot(offset, relative);
    float inside = closing * closing - speed_squared * (dot(offset, offset) - reach * reach);
    root = sqrt(max(inside, 0.0));
    if (inside <= 0.0 || speed_squared < 1.0e-6) return -1.0;
    return (closing - root) / speed_squared;
}

/// m/s^2: the acceleration that makes room for one other person.
vec2 repulsion(vec2 offset, vec2 relative, float reach) {
    if (!ROOM_BY_TIME_TO_COLLISION_ENABLED) return vec2(0.0);
    // Bodies that touch are contact's business; the law is evaluated as if they were just apart.
    reach = min(reach, ROOM_BY_TIME_TO_COLLISION_CLOSEST * length(offset));
    float root;
    float time = timeToCollision(offset, relative, reach, root);
    if (time <= 0.0 || time > parameters.time_horizon) return vec2(0.0);
    float speed_squared = dot(relative, relative);
    vec2 across = relative - (speed_squared * offset - dot(offset, relative) * relative) / root;
    float strength = ROOM_BY_TIME_TO_COLLISION_STRENGTH * exp(-time / ROOM_BY_TIME_TO_COLLISION_HORIZON) /
                     (speed_squared * time * time) * (2.0 / time + 1.0 / ROOM_BY_TIME_TO_COLLISION_HORIZON);
    return atMost(-strength * across, ROOM_BY_TIME_TO_COLLISION_MOST);
}
