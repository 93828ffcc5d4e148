// SPDX-License-Identifier: Apache-2.0
// How one person makes room for another. Needs the block ParametersBlock and shaders/shared/at_most.glsl.
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

/// 0 to 1.
float impatienceOf(float nervousness) { return clamp((nervousness - PATIENT) / (IMPATIENT - PATIENT), 0.0, 1.0); }

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

/// Walking behind somebody takes room to step: the free way ahead is to last for one's headway, whatever is left of it,
/// one creeps (Tordeux, Chraibi and Seyfried 2016, equation 2, with the free way between discs). Crowds that walk one way then slow
/// down with their density as people's do (Weidmann 1993).
const float SLOWEST_PACE = 0.1;       // m/s
const float STRAIGHT_AHEAD = 0.7;     // of the sum of the radii: further aside, one could pass
const float LEAST_HEADWAY = 0.01;     // s: less is none

/// s: those who were given no headway keep this one while they are patient and everybody they sense goes their way: a
/// platoon that walks on by itself spreads. A tight one would enclose whoever crosses its way and carry them off. Where
/// streams meet they close up, because there a headway only gives room away to those who come across.
const float HEADWAY_IN_PEACE = 0.1;

/// How much two who want to go this way and that walk behind each other, 0 to 1.
float followed(float alike) { return smoothstep(0.3, 0.8, alike); }

float likeness(vec2 way, vec2 wish) {
    float size = length(wish);
    return size > STANDING_SPEED ? dot(way, wish) / size : -1.0;  // whoever stands is walked around
}

/// m/s: how fast one walks behind one other person, at most `speed`.
/// @param offset from oneself to the other, m
float paceBehind(vec2 way, float speed, float headway, vec2 offset, float reach, vec2 wish) {
    // Of two who make for the same door, one is ahead: the other follows, and they do not wait for each other.
    float size = length(wish);
    if (size <= STANDING_SPEED || dot(offset, way + wish / size) <= 0.0) return speed;
    float ahead = dot(offset, way);
    float aside_squared = max(dot(offset, offset) - ahead * ahead, 0.0);
    if (ahead <= 0.0 || aside_squared >= STRAIGHT_AHEAD * STRAIGHT_AHEAD * reach * reach) return speed;
    float free = ahead - sqrt(reach * reach - aside_squared);
    return mix(speed, clamp(free / headway, min(SLOWEST_PACE, speed), speed), followed(likeness(way, wish)));
}

/// What somebody's wish, patience and surroundings make of the room that others would like.
struct Manners {
    vec2 way;          // where it wants to go, of unit length
    float impatience;  // 0 to 1
    float crowding;    // 0 to 1
    float follows;     // 1 where it was given a headway, 0 where it pushes on
    float freedom;     // 0 to 1: how little those ahead hold it up
};

Manners mannersOf(vec2 way, float impatience, uint sensed, float headway, float pace_share) {
    float crowding = clamp((float(sensed) - SWERVE_FREELY) / (SWERVE_NO_MORE - SWERVE_FREELY), 0.0, 1.0);
    return Manners(way, impatience, crowding, headway > 0.0 ? 1.0 : 0.0, smoothstep(0.7, 1.0, pace_share));
}

/// The acceleration, m/s^2, that makes room for somebody who wants to go `wish` (m/s).
/// @param relative one's own velocity less the other's; `overtaking` the same for one's own wished velocity
vec2 roomFor(Manners manners, vec2 offset, vec2 relative, vec2 overtaking, float reach, vec2 wish) {
    float alike = likeness(manners.way, wish);
    float oncoming = smoothstep(0.2, 0.8, -alike);
    float behind = followed(alike) * manners.follows;
    float patience = 1.0 - manners.impatience;
    vec2 touch = cushion(offset, relative, reach) * patience;
    reach += FOLLOWING_GAP * followed(alike) * patience;
    // Who follows looks for a way past at the speed it would like; its pace does the braking, and it does not hurry for
    // those behind.
    vec2 room = repulsion(offset, mix(relative, overtaking, behind), reach);
    float along = dot(room, manners.way);
    float swerve = patience * mix(1.0 - manners.crowding, manners.freedom, behind);
    vec2 aside = (room - manners.way * along) * mix(swerve, 1.0, oncoming);
    along *= 1.0 - behind;
    if (along < 0.0) along *= 1.0 - max(oncoming, manners.impatience);
    return manners.way * along + aside + touch;
}
