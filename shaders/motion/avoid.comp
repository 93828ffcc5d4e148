// SPDX-License-Identifier: Apache-2.0
// The next velocity: towards the wished one, making room for everybody sensed, along walls, within what legs can do.
// Each rule is a file of shaders/motion, and its numbers are a row of the table `motion` of the layout's schema: the
// constants RULE_PARAMETER.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer Walkers { Walker walkers[]; };
layout(std430) readonly buffer PreferredVelocities { vec2 preferred_velocities[]; };
layout(std430) readonly buffer Neighbours { uint neighbours[]; };
layout(std430) readonly buffer NeighbourCounts { uint neighbour_counts[]; };
layout(std430) buffer TouchWords { uint touch_words[]; };
layout(std430) readonly buffer WallSegments { WallSegment wall_segments[]; };
layout(std430) readonly buffer WallStarts { uint wall_starts[]; };
layout(std430) readonly buffer WallItems { uint wall_items[]; };
layout(std430) readonly buffer RoadDistances { float road_distances[]; };
layout(std430) writeonly buffer Targets { TARGET targets[]; };  // where each person will be unless bodies touch
layout(std430) writeonly buffer TargetsAfter { TARGET targets_after[]; };  // the same, where contact passes over
layout(std430) writeonly buffer Ways { vec2 ways[]; };  // m: what is meant to be added to places; on wide sites
layout(std430) writeonly buffer Decisions { Decision decisions[]; };
uniform uint slot_capacity;

// Room for the nearest walls, vehicles and the kerb.
#ifdef TRAFFIC
#define CONSTRAINT_CAPACITY (int(WALL_CONSTRAINTS) + 4)
#else
#define CONSTRAINT_CAPACITY (int(WALL_CONSTRAINTS) + 1)
#endif

#include "shaders/shared/at_most.glsl"
#include "shaders/shared/images.glsl"
#include "shaders/shared/snap.glsl"
#include "shaders/cells/cells.glsl"
#include "shaders/cells/walls_near.glsl"
#include "shaders/shared/walls.glsl"
#include "shaders/motion/climbing.glsl"
#include "shaders/motion/linear_program.glsl"
#include "shaders/shared/body_shape.glsl"
#include "shaders/motion/half_width.glsl"
#include "shaders/motion/drive.glsl"
#include "shaders/motion/among_all.glsl"
#include "shaders/motion/walls_ahead.glsl"
#include "shaders/motion/kerb.glsl"
#include "shaders/motion/company.glsl"
#include "shaders/motion/under_way.glsl"
#include "shaders/motion/planted_feet.glsl"
#include "shaders/motion/at_rest.glsl"
#include "shaders/motion/wanting_past.glsl"
#include "shaders/motion/wide_site.glsl"
#include "shaders/motion/shoulders.glsl"
#include "shaders/motion/gap_ahead.glsl"
#ifdef BODIES
#define TWIST , twist, 0u
#else
#define TWIST
#endif
#ifdef BELTS
#include "shaders/shared/random.glsl"
#include "shaders/charts/belts.glsl"
#include "shaders/motion/riding.glsl"
#include "shaders/motion/spacing_on_belts.glsl"
#endif
#include "shaders/motion/stride.glsl"
#if defined(TRAFFIC) || defined(LIFTS)
#include "shaders/traffic/held.glsl"
#endif
#ifdef TRAFFIC
#include "shaders/traffic/boxes.glsl"
#include "shaders/traffic/way_ahead.glsl"
#include "shaders/traffic/out_of_the_way.glsl"
#endif

/// Of those sensed who are under way. @param flags one's own, or 0 where one is not on stairs
bool anybodyIsOncoming(uint slot, uint flags) {
    bool found = false;
    for (uint i = 0u; i < neighbour_counts[slot]; ++i) {
        uint key = neighbourKey(slot, i);
        if ((key & NEIGHBOUR_IS_WALL) != 0u || !wantsOn(preferred_velocities[key])) continue;
        bool comes = isOnStairs(flags) ? comesOnStairs(flags, preferred_velocities[slot], walkers[key],
                                                       preferred_velocities[key])
                                       : isOncoming(walkers[slot].way_through, walkers[key].way_through);
        found = found || comes;
    }
    return found;
}

/// Finds out who goes one after another: in narrow passages and on stairs, but where others come the other way.
/// @returns whether somebody does so on stairs
bool climbsInTurn(uint slot, uint flags) {
    uint touch_word = touch_words[slot];
    bool climbs = CLIMBING_ENABLED && isOnStairs(flags);
    if (!climbs && (touch_word & TOUCH_IN_NARROWS) == 0u) return false;
    bool in_turn = !anybodyIsOncoming(slot, climbs ? flags : 0u);
    touch_words[slot] = in_turn ? touch_word | TOUCH_IN_NARROWS : touch_word & ~TOUCH_IN_NARROWS;
    return climbs && in_turn;
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count || isImage(walkers[slot].flags)) return;
    Body self = bodies[slot];
    Walker walker = walkers[slot];
#ifdef BODIES
    axis_of_self = vec2(walker.axis_x, walker.axis_y);
#endif
#if defined(DOORS) && defined(PARTIES)
    if ((walker.flags & WALKER_IN_DOORS) != 0u) walker.party_size = 1u;  // nobody waits for company in a door
#endif
    vec2 wish = preferred_velocities[slot];
#ifdef BELTS
    float allowed = RIDING_ENABLED ? paceOnBelt(self, walker, slot, length(wish)) : length(wish);
    bool wants = length(wish) > STANDING_SPEED;
    wish = keepingBehind(walker.flags, wish, allowed);
    bool waits = wants && length(wish) <= STANDING_SPEED;
#endif
    float speed = length(wish);
    vec2 way = speed > STANDING_SPEED ? wish / speed : vec2(cos(self.heading), sin(self.heading));

    // Manners depend on the pace of those with a headway of their own only; the others look at everybody just once.
    float headway = headwayOf(walker);
#if defined(TRAFFIC) || defined(LIFTS)
    headway = max(headway, headwayBeforeRed(walker.flags));
#endif
    bool climbs = climbsInTurn(slot, walker.flags);
    float kept = climbs ? max(headway, headwayOnStairs(walker.flags)) : headway;
#ifdef BELTS
    kept = max(kept, headwayBeforeBelt(walker.flags));
#endif
    float pace = paceAmongAll(self, slot, way, speed, kept);
    bool strides = false, is_met = false;
#ifdef BODIES
    if (!climbs && kept <= 0.0) {
        Striding found = strideAmongAll(self, walker, way, speed, slot);
        strides = found.strides;
        is_met = found.is_met;
        if (strides) pace = found.pace;
    }
#endif
    bool follows = strides || headway > 0.0;
    float impatience = impatienceOf(walker.nervousness);
    if (climbs) impatience = 0.0;
#ifdef BELTS
    if (RIDING_ENABLED && (walker.flags & WALKER_RIDES) != 0u) impatience = 0.0;  // people queue, and do not press
#endif
#if defined(TRAFFIC) || defined(LIFTS)
    if (isHeld(walker.flags)) impatience = 0.0;
#endif
    Manners manners = Manners(way, impatience, crowdingAmong(neighbour_counts[slot]), follows ? 1.0 : 0.0,
                              freedomAt(pace / max(speed, STANDING_SPEED)), hurryingOf(is_met, impatience),
                              toTheRight(hasBody(walker), is_met));
    float in_peace = HEADWAY_IN_PEACE_ENABLED && !follows ? headwayInPeace(impatience) : 0.0;
    Surroundings around = lookAround(self, slot, wish, speed, in_peace, manners);
    if (around.in_peace) pace = min(pace, around.pace);
    vec2 acceleration = drive(wish, speed, pace, self.velocity) +
                        notLedAway(walker, way, around.room * shareOfRoom(speed)) +
                        company(self, walker, way, speed);
    vec2 wanted = self.velocity + acceleration * parameters.decision_seconds;
    vec2 legs = self.velocity;  // what they start from
    uint feet = (around.in_traffic ? FEET_IN_TRAFFIC : 0u) | (around.in_peace && follows ? FEET_WAIT : 0u);
    if ((walker.flags & WALKER_AT_REST) != 0u && !somebodyWantsPast(self, slot)) feet |= FEET_STILL;
#ifdef BELTS
    if (waits) feet |= FEET_STILL;  // it does not let itself be pushed on
#endif
    plantFeet(self, walker, feet, wanted, legs);
    keepFeetStill(feet, wanted, legs);

    int hard = wallsAhead(self, walker, slot);
#ifdef TRAFFIC
    hard += vehiclesAhead(self, slot, hard, (walker.flags & WALKER_IN_DOORS) != 0u);
#endif
    if (strides) touch_words[slot] &= ~TOUCH_IN_NARROWS;  // and takes no turns
    int count = hard + kerbBeside(self, walker, hard);
    vec2 velocity = nearestAllowed(hard, count, self.maximum_speed, wanted);
    velocity = limitChange(legs, velocity, parameters.maximum_acceleration * parameters.decision_seconds);
    vec2 change = (velocity - legs) * (parameters.step_seconds / parameters.decision_seconds);
    float twist = twistAhead(self, walker, way);
#ifdef BELTS
    pace = min(pace, allowed);  // which is not being held up
#endif
    decisions[slot] = Decision(change, pace, feet TWIST);
    if (parameters.decision_seconds > parameters.step_seconds) velocity = legs + change;
#ifdef WIDE_SITE
    vec2 rest = states[self.row].rest;
#else
    vec2 rest = vec2(0.0);
#endif
    stride(slot, self.position, velocity, rest, twist);
}
