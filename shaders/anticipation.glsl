// SPDX-License-Identifier: Apache-2.0
// How one person makes room for another. Needs the block ParametersBlock and shaders/at_most.glsl.
//
// People do not react to how near somebody is but to how soon they would collide: from trajectories of real pedestrians,
// the energy of a pair that would touch in t seconds is k / t^2 exp(-t / t0) (Karamouzas, Skinner and Guy 2014, equations
// 3 and 4). Its downhill gradient is an acceleration that points across the relative velocity while there is time, and
// back along it when there is none: people go round each other first, and brake last.
//
// In a dense crowd that is too polite. Who brakes for everybody that comes the other way never gets through, and everybody
// behind stops too: opposing streams freeze at the line where they meet. Two observations undo this.
//  - Two who walk straight at each other only swerve; they do not change their speeds. Those who cross do both (Huber et
//    al. 2014). So nobody brakes for oncoming people, and lanes form by themselves, because a swerve ends only behind
//    somebody who goes the same way.
//  - Held up for long, people grow impatient: they stop making room and push (Helbing, Farkas and Vicsek 2000, the
//    nervousness 1 - v / v0). So braking and swerving fade as somebody is held up, except swerving for oncoming people,
//    and contact keeps bodies apart. That is how streams that cross at right angles get through each other.

const float REPULSION = 1.5;         // m^2/s^2: k, as fitted there for a person of unit mass
const float REPULSION_HORIZON = 3.0; // s: t0, as fitted there
const float MOST_REPULSION = 20.0;   // m/s^2, of one person on another: the law has no upper bound

/// Those who walk behind each other leave room to step (m, beyond touching) while they are patient.
const float FOLLOWING_GAP = 0.1;

/// Where this many others are near, swerving for those who cross only sweeps people along with them: it fades.
const float SWERVE_FREELY = 3.0;
const float SWERVE_NO_MORE = 7.0;

const float PATIENT = 0.05;    // held up less than this, of the wished speed: as polite as can be
const float IMPATIENT = 0.25;  // from here on nobody makes room any more

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
    // Bodies that touch are contact's business; the law is evaluated as if they were just apart.
    reach = min(reach, 0.95 * length(offset));
    float root;
    float time = timeToCollision(offset, relative, reach, root);
    if (time <= 0.0 || time > parameters.time_horizon) return vec2(0.0);
    float speed_squared = dot(relative, relative);
    vec2 across = relative - (speed_squared * offset - dot(offset, relative) * relative) / root;
    float strength = REPULSION * exp(-time / REPULSION_HORIZON) / (speed_squared * time * time) *
                     (2.0 / time + 1.0 / REPULSION_HORIZON);
    return atMost(-strength * across, MOST_REPULSION);
}

/// Nobody walks into anybody: closing speeds that would use up the gap within CUSHION are taken back, half by each of the
/// two, at a rate that leaves little for the hard contact to stop at once.
const float CUSHION = 0.25;        // s
const float CUSHION_RATE = 5.0;    // 1/s
vec2 cushion(vec2 offset, vec2 relative, float reach) {
    float distance = max(length(offset), 1.0e-3);
    float closing = -dot(offset, relative) / distance;
    float excess = closing - max(distance - reach, 0.0) / CUSHION;
    return excess > 0.0 ? offset * (excess * CUSHION_RATE / distance) : vec2(0.0);
}

/// What one's own way and patience leave of the room made for somebody who wants to go `wish` (m/s).
/// @param way where oneself wants to go, of unit length
/// @param impatience, crowding 0 to 1
vec2 roomFor(vec2 way, float impatience, float crowding, vec2 offset, vec2 relative, float reach, vec2 wish) {
    float size = length(wish);
    float alike = size > STANDING_SPEED ? dot(way, wish) / size : -1.0;  // whoever stands is walked around
    float oncoming = smoothstep(0.2, 0.8, -alike);
    vec2 touch = cushion(offset, relative, reach) * (1.0 - impatience);
    reach += FOLLOWING_GAP * smoothstep(0.3, 0.8, alike) * (1.0 - impatience);
    vec2 room = repulsion(offset, relative, reach);
    float along = dot(room, way);
    vec2 aside = (room - way * along) * mix((1.0 - impatience) * (1.0 - crowding), 1.0, oncoming);
    if (along < 0.0) along *= 1.0 - max(oncoming, impatience);
    return way * along + aside + touch;
}
