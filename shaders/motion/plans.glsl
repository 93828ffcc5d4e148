// SPDX-License-Identifier: Apache-2.0
// Plans: routes advance stage by stage, with stops and lines on the way, until somebody arrives; and events change
// them.
// Needs the block ParametersBlock, where a scene has them People, PlanChanges and WaitingLines, the uniform steps_done,
// shaders/routes/route.glsl and shaders/motion/waiting_line.glsl.

/// Who waits at a spot in an area stays where it has come to rest (shaders/motion/at_rest.glsl): only then is it there.
bool standsThere(Stage stage) {
    return AT_REST_ENABLED && (stage.flags & STAGE_IN_AREA) != 0u && stage.dwell > 0.0;
}

/// How nervous somebody gets before it gives up getting nearer: outside of an area, the more so the further it is.
float patienceBefore(Stage stage, float remaining) {
    return standsThere(stage) ? mix(ARRIVING_GIVES_UP, 1.0, remaining / ARRIVING_NEAR_BY) : ARRIVING_GIVES_UP;
}

/// Whether somebody is where its stage leads. Where there are too many for a place, near by will do in the end.
bool isThere(AgentState state, Stage stage, RouteAhead ahead) {
#ifdef WAITING_LINES
    if (stage.line != NO_INDEX && (state.ticket == NO_INDEX || state.ticket != waiting_lines[stage.line].served))
        return false;
#endif
    if (ahead.remaining <= stage.tolerance) return !standsThere(stage) || length(state.velocity) <= STANDING_SPEED;
    if ((stage.flags & STAGE_ANYWHERE) == 0u) return false;
    bool in_area = (stage.flags & STAGE_IN_AREA) != 0u && ahead.straight;
    return (in_area || ahead.remaining < ARRIVING_NEAR_BY) &&
           state.nervousness > patienceBefore(stage, in_area ? 0.0 : ahead.remaining);
}

/// Who comes to the end of a line joins it at the end of the step; of several, the smallest row.
void askToJoin(AgentState state, Stage stage, uint row) {
#ifdef WAITING_LINES
    if (stage.line == NO_INDEX || state.ticket != NO_INDEX || state.leave_step != 0u) return;
    if (distance(stage.point, state.position) < ARRIVING_JOINS_LINE)
        atomicMin(waiting_lines[stage.line].candidate, row);
#endif
}

uint stepAfter(float seconds) { return steps_done + max(uint(seconds / parameters.step_seconds), 1u); }

/// Whether what comes next is to stand on where one stands: behaviours tell what people do then, once these decide.
bool staysThere(Stage left, Stage next) {
    return next.line == NO_INDEX && next.point == left.point && next.dwell > 0.0 && next.dwell < DWELL_FOR_GOOD;
}

void goOn(inout AgentState state) {
    bool stood = state.leave_step != 0u;
    state.stage += 1u;
    state.leave_step = 0u;
    state.ticket = NO_INDEX;
    if (state.stage < state.stage_end) {
        Stage next = stages[state.stage];
        if (stood && staysThere(stages[state.stage - 1u], next)) state.leave_step = stepAfter(next.dwell);
        return;
    }
    state.stage = state.stage_end - 1u;
    state.status = STATUS_GONE;
    state.arrival_step = steps_done;
}

/// Stops, waits, goes on, arrives.
/// @param ahead from where it is now
void followRoute(inout AgentState state, Stage stage, RouteAhead ahead, uint row) {
    if (state.status != STATUS_WALKING) return;
    askToJoin(state, stage, row);
    if (state.leave_step != 0u) {
        if (steps_done >= state.leave_step) goOn(state);
        return;
    }
    if (!isThere(state, stage, ahead)) return;
    if (stage.dwell <= 0.0) {
        goOn(state);
    } else if (stage.dwell >= DWELL_FOR_GOOD) {
        state.status = STATUS_ARRIVED;
        state.arrival_step = steps_done;
    } else {
        state.leave_step = stepAfter(stage.dwell);
    }
}

/// @returns whether plans have changed
bool changePlans(inout AgentState state, Walker walker, uint row) {
#ifdef PLAN_CHANGES
    if (state.changes >= walker.change_count) return false;
    PlanChange change = plan_changes[people[row].first_change + state.changes];
    if (change.start_step > steps_done) return false;
    state.changes += 1u;
    state.stage = change.first_stage;
    state.stage_end = change.first_stage + change.stage_count;
    state.status = STATUS_WALKING;
    state.arrival_step = NO_INDEX;
    state.leave_step = 0u;
    state.ticket = NO_INDEX;
    return true;
#else
    return false;
#endif
}
