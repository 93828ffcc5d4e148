// SPDX-License-Identifier: Apache-2.0
// What it takes to do it: where everybody who has a behaviour goes, and for how long. Each of them has two stages of
// its own: the first leads to its goal, and it is at the second when it has been there (shaders/motion/plans.glsl); so
// routes, avoidance and waiting know nothing of behaviours.
#include "shaders/shared/simulation_types.h"
#include "shaders/shared/behaviour_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) buffer States { AgentState states[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) buffer Walkers { Walker walkers[]; };
layout(std430) buffer Stages { Stage stages[]; };
layout(std430) readonly buffer BehaviourStates { BehaviourState behaviour_states[]; };
layout(std430) readonly buffer BehaviourPlaces { BehaviourPlace behaviour_places[]; };
layout(std430) readonly buffer BehaviourPoints { vec2 behaviour_points[]; };
layout(std430) readonly buffer WallSegments { WallSegment wall_segments[]; };
layout(std430) readonly buffer WallStarts { uint wall_starts[]; };
layout(std430) readonly buffer WallItems { uint wall_items[]; };
layout(std430) readonly buffer DetourSlopes { vec2 detour_slopes[]; };
layout(std430) buffer Minds { Mind minds[]; };
uniform usamplerBuffer field_cells;  // FieldCell
uniform uint steps_done;             // counted with this one

#include "shaders/shared/random.glsl"
#include "shaders/shared/walker.glsl"
#include "shaders/shared/images.glsl"
#include "shaders/shared/alive.glsl"
#include "shaders/cells/cells.glsl"
#include "shaders/cells/walls_near.glsl"
#include "shaders/cells/cell_runs.glsl"
#include "shaders/routes/route.glsl"
#include "shaders/behaviour/draws.glsl"
#include "shaders/behaviour/outlines.glsl"
#include "shaders/behaviour/clear_way.glsl"
#include "shaders/behaviour/spots.glsl"
#include "shaders/behaviour/places.glsl"
#include "shaders/behaviour/wandering.glsl"
#include "shaders/behaviour/moving_goals.glsl"
#include "shaders/behaviour/letting_go.glsl"

const uint STAND_ANYWHERE = STAGE_ANYWHERE | STAGE_IN_AREA;

/// Sets off to a goal.
void setOff(Seeker seeker, Mind mind, BehaviourState doing, Stage stage) {
    stages[mind.first_stage] = stage;
    Stage after = stage;
    after.dwell = DWELL_WHILE;
    after.flags = STAND_ANYWHERE;
    after.line = NO_INDEX;
    stages[mind.first_stage + 1u] = after;
    bool leaves = (doing.flags & STATE_LEAVES) != 0u;
    states[seeker.row].stage = walkers[seeker.slot].stage = mind.first_stage;
    states[seeker.row].stage_end = walkers[seeker.slot].stage_end = mind.first_stage + (leaves ? 1u : 2u);
    states[seeker.row].status = walkers[seeker.slot].status = STATUS_WALKING;
    states[seeker.row].leave_step = walkers[seeker.slot].leave_step = 0u;
    states[seeker.row].ticket = NO_INDEX;
#ifdef WAITING_LINES
    walkers[seeker.slot].ticket = NO_INDEX;
#endif
    states[seeker.row].arrival_step = NO_INDEX;
    states[seeker.row].shortest_way = states[seeker.row].walked + routeAhead(stage, seeker.position).remaining;
}

Stage stageTo(vec2 point, uint field, BehaviourState doing) {
    Stage stage;
    stage.point = stage.facing = point;
    stage.tolerance = 0.3;
    stage.field = field;
    stage.dwell = 0.0;
    stage.line = NO_INDEX;
    stage.activity = doing.activity;
    stage.flags = 0u;
    stage.beyond = 0.0;
    stage.board = 0u;
    return stage;
}

/// s at a place.
float stayAt(BehaviourState doing, Seeker seeker, Mind mind) {
    return drawnNumber(doing.lasts, PURPOSE_STAY, seeker.leader, mind.entered * PICKS_OF_A_STATE + mind.visits_left);
}

Stage stageAtSpot(BehaviourState doing, Seeker seeker, Mind mind) {
    BehaviourPlace place = behaviour_places[mind.place];
    vec2 middle = freeSpot(place, seeker, mind);
    Stage stage = stageTo(middle + ringOffset(seeker), place.field | FIELD_THEN_POINT, doing);
    bool has_sight = place.facing != place.middle;
    stage.facing = has_sight || seeker.party_size < 2u ? place.facing : middle;
    if ((doing.flags & STATE_FACES) != 0u) stage.facing = doing.facing;
    stage.dwell = stayAt(doing, seeker, mind);
    stage.flags = STAND_ANYWHERE;
    return stage;
}

Stage stageHere(BehaviourState doing, Seeker seeker, Mind mind) {
    Stage stage = stageTo(seeker.position, NO_INDEX, doing);
    stage.facing = (doing.flags & STATE_FACES) != 0u ? doing.facing : seeker.position + 10.0 * seeker.ahead;
    stage.tolerance = 1.0;
    stage.dwell = stayAt(doing, seeker, mind);
    stage.flags = STAND_ANYWHERE;
    return stage;
}

/// Through, and on; or to stand there for a while.
Stage stageWandering(BehaviourState doing, Seeker seeker, Mind mind, vec2 spot) {
    Stage stage = stageTo(spot, behaviour_places[mind.place].field | FIELD_THEN_POINT, doing);
    stage.dwell = stayAt(doing, seeker, mind);
    stage.flags = stage.dwell > 0.0 ? STAND_ANYWHERE : STAGE_ANYWHERE;
    stage.tolerance = stage.dwell > 0.0 ? 0.3 : 0.8;
    stage.facing = spot + (spot - seeker.position);
    return stage;
}

/// Where one waits until one can go in (shaders/seats/lead.comp); those who cannot get nearer stop beside it.
Stage stageBeforeAisle(BehaviourState doing, Mind mind) {
    BehaviourPlace place = behaviour_places[mind.place];
    Stage stage = stageTo(place.middle, place.field | FIELD_THEN_POINT, doing);
    stage.dwell = DWELL_WHILE;
    stage.activity = ACTIVITY_STAND;
    stage.flags = STAGE_ANYWHERE;
    return stage;
}

/// The place's middle is the front of the line.
Stage stageInLine(BehaviourState doing, Seeker seeker, Mind mind) {
    BehaviourPlace place = behaviour_places[mind.place];
    Stage stage = stageTo(place.middle, place.field | FIELD_THEN_POINT, doing);
    stage.facing = (doing.flags & STATE_FACES) != 0u ? doing.facing : place.facing;
    stage.line = doing.line;
    stage.dwell = stayAt(doing, seeker, mind);
    return stage;
}

void beginState(Seeker seeker, inout Mind mind, BehaviourState doing) {
    mind.flags &= ~MIND_NEEDS_GOAL;
    switch (doing.does) {
        case DOES_WALK:
            mind.place = choosePlace(doing, seeker, mind);
            BehaviourPlace place = behaviour_places[mind.place];
            setOff(seeker, mind, doing, stageTo(place.middle, place.field, doing));
            break;
        case DOES_GATHER:
            mind.place = choosePlace(doing, seeker, mind);
            setOff(seeker, mind, doing, stageAtSpot(doing, seeker, mind));
            break;
        case DOES_VISIT:
            visitNext(doing, seeker, mind);
            setOff(seeker, mind, doing, stageAtSpot(doing, seeker, mind));
            break;
        case DOES_WANDER:
            mind.place = doing.first_place;
            setOff(seeker, mind, doing, stageWandering(doing, seeker, mind, nextSpot(seeker, mind)));
            break;
        case DOES_SIT:
            mind.place = doing.first_place + mind.seat;
            setOff(seeker, mind, doing, stageBeforeAisle(doing, mind));
            break;
        case DOES_QUEUE:
            mind.place = doing.first_place;
            setOff(seeker, mind, doing, stageInLine(doing, seeker, mind));
            break;
        default:
            setOff(seeker, mind, doing, stageHere(doing, seeker, mind));
            break;
    }
}

/// A goal that moves leaves people under way as long as it is further than a step.
void keepUp(Seeker seeker, Mind mind, vec2 goal) {
    const float A_STEP = 0.6;  // m
    stages[mind.first_stage].point = goal;
    if (distance(goal, seeker.position) <= A_STEP) return;
    states[seeker.row].leave_step = walkers[seeker.slot].leave_step = 0u;
    states[seeker.row].stage = walkers[seeker.slot].stage = mind.first_stage;
}

/// Somebody who was here first has taken its spot, and it sees that from near.
bool hasLostSpot(Seeker seeker, AgentState state, vec2 goal) {
    const float SEES = 2.5;    // m
    const float STANDS = 0.1;  // m/s
    return state.leave_step == 0u && state.status == STATUS_WALKING && distance(goal, seeker.position) < SEES &&
           isTaken(seeker, goal, STANDS);
}

void goOn(Seeker seeker, inout Mind mind, BehaviourState doing, AgentState state) {
    bool has_been_there = state.stage != mind.first_stage;
    bool at_spot = doing.does == DOES_GATHER || doing.does == DOES_VISIT;
    bool goes_on = doing.does == DOES_VISIT && mind.visits_left > 0u || doing.does == DOES_WANDER;
    if (goes_on && has_been_there) {
        if (isLettingGo(mind, doing, true)) return;
        mind.let_go = 0u;
    }
    if (doing.does == DOES_VISIT && has_been_there && mind.visits_left > 0u) {
        visitNext(doing, seeker, mind);
        setOff(seeker, mind, doing, stageAtSpot(doing, seeker, mind));
    } else if (at_spot && !has_been_there && mind.picks % PICKS_OF_A_STATE < PICKS_OF_A_STATE - 1u &&
               hasLostSpot(seeker, state, stages[mind.first_stage].point)) {
        mind.picks += 1u;
        setOff(seeker, mind, doing, stageAtSpot(doing, seeker, mind));
    } else if (doing.does == DOES_WANDER && (has_been_there || choosesAnew(seeker, mind, state.nervousness))) {
        mind.picks += 1u;
        setOff(seeker, mind, doing, stageWandering(doing, seeker, mind, nextSpot(seeker, mind)));
    } else if (doing.does == DOES_SIT && looksRoundAgain(seeker)) {
        keepUp(seeker, mind, behaviour_places[mind.place].middle);
    } else if (doing.does == DOES_FLEE) {
        keepUp(seeker, mind, awayFromDanger(seeker, mind, doing));
    } else if (doing.does == DOES_FOLLOW) {
        chooseLeader(seeker, mind, doing);
        keepUp(seeker, mind, behindLeader(seeker, mind, doing));
    }
}

Seeker seekerIn(uint slot) {
    Body body = bodies[slot];
    Walker walker = walkers[slot];
    uint leader = partyFirstOf(walker, body.row);
    return Seeker(slot, body.row, leader, body.row - leader, partySizeOf(walker), body.position,
                  vec2(cos(body.heading), sin(body.heading)), body.radius);
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count || isImage(walkers[slot].flags)) return;
    uint row = bodies[slot].row;
    Mind mind = minds[row];
    if (mind.state == NO_INDEX || mind.entered == 0u) return;
    AgentState state = states[row];
    if (state.stage - mind.first_stage > 1u) return;  // an event has sent it elsewhere
    BehaviourState doing = behaviour_states[mind.state];
    Seeker seeker = seekerIn(slot);
    if ((mind.flags & MIND_NEEDS_GOAL) != 0u)
        beginState(seeker, mind, doing);
    else
        goOn(seeker, mind, doing, state);
    minds[row] = mind;
    walkers[slot].preferred_speed = min(walkers[slot].preferred_speed * doing.pace, bodies[slot].maximum_speed);
}
