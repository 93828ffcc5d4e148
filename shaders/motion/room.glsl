// SPDX-License-Identifier: Apache-2.0
// How one person makes room for another: what the rules make of it together.
//
// Room by time to collision alone is too polite for a dense crowd. Who brakes for everybody that comes the other way
// never gets through, and everybody behind stops too: opposing streams freeze at the line where they meet. So nobody
// brakes for oncoming people, who is held up grows impatient and makes less room, and in a crowd nobody swerves for
// those who cross.
// Needs the block ParametersBlock and shaders/shared/at_most.glsl.
#include "shaders/motion/walking_behind.glsl"
#include "shaders/motion/room_by_time_to_collision.glsl"
#include "shaders/motion/no_braking_for_oncoming.glsl"
#include "shaders/motion/impatience.glsl"
#include "shaders/motion/no_swerving_in_crowds.glsl"
#include "shaders/motion/passing_side.glsl"
#include "shaders/motion/cushion.glsl"
#include "shaders/motion/room_to_step.glsl"
#include "shaders/motion/headway.glsl"

/// What somebody's wish, patience and surroundings make of the room that others would like.
struct Manners {
    vec2 way;            // where it wants to go, of unit length
    float impatience;    // 0 to 1
    float crowding;      // 0 to 1
    float follows;       // 1 where it was given a headway, 0 where it pushes on
    float freedom;       // 0 to 1: how little those ahead hold it up
    float hurrying;      // 0 to 1: how much it hurries for those who come up from behind
    float to_the_right;  // of the room made for somebody oncoming: so much more of it to that side
};

/// The acceleration, m/s^2, that makes room for somebody who wants to go `wish` (m/s).
/// @param relative one's own velocity less the other's; `overtaking` the same for one's own wished velocity
vec2 roomFor(Manners manners, vec2 offset, vec2 relative, vec2 overtaking, float reach, vec2 wish) {
    float alike = likeness(manners.way, wish);
    float oncoming = oncomingOf(alike);
    float behind = followed(alike) * manners.follows;
    float patience = 1.0 - manners.impatience;
    vec2 touch = cushion(offset, relative, reach, patience);
    reach += roomToStep(alike, patience);
    // Who follows looks for a way past at the speed it would like; its pace does the braking, and it does not hurry for
    // those behind.
    vec2 room = repulsion(offset, mix(relative, overtaking, behind), reach);
    float along = dot(room, manners.way);
    float swerve = patience * mix(1.0 - manners.crowding, manners.freedom, behind);
    vec2 aside = (room - manners.way * along) * mix(swerve, 1.0, oncoming);
    if (HAVE_SIDES) aside += passingSide(manners.way, manners.to_the_right, oncoming, room);
    along *= 1.0 - behind;
    if (along > 0.0) along *= 1.0 - followed(alike) * (1.0 - manners.hurrying);
    if (along < 0.0) along *= 1.0 - max(unbraked(oncoming), manners.impatience);
    return manners.way * along + aside + touch;
}

/// Who stands somewhere is walked around, and makes only some of the room that somebody under way would make.
float shareOfRoom(float speed) {
    return speed > STANDING_SPEED || !ROOM_OF_THE_STANDING_ENABLED ? 1.0 : ROOM_OF_THE_STANDING_SHARE;
}
