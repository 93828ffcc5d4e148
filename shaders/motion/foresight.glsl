// SPDX-License-Identifier: Apache-2.0
// Foresight: legs take their time to answer (drive), so people turn into a bend and slow down before a place as long
// before they are there. Who went by where it is would swing out after every corner, and walk past its goal and back.
// Needs shaders/routes/route.glsl and shaders/shared/walker.glsl.

/// s: by how much longer decisions stand than those that the rule's numbers were found with.
float laterThanUsual() { return max(parameters.decision_seconds - FORESIGHT_USUAL, 0.0); }

/// The coarse map of jams knows of no jamb: its slope leads straight to where there is room, and who stands at a jamb
/// walks into it, the better the worse the jam is. So who strides and does not get on in a narrow passage, or close
/// before one, goes by the free way, round the jamb. On stairs there is no other way, and the map is as coarse as they
/// are wide: who heeded it there would turn into the balustrade, or back up. Who has no body to stride with presses
/// through.
bool heedsJams(Walker walker, bool narrow, bool on_stairs) {
    if (!hasBody(walker)) return true;
    return !on_stairs && (!narrow || walker.nervousness < ROUTES_ROUND_JAMS_STUCK);
}

/// The way from where one will be, or from where one is, if there might be a wall in between: beyond that, the way is
/// longer or shorter by more than what was walked. Jams are heeded as they are, if at all.
RouteAhead wayAhead(Stage stage, vec2 position, vec2 velocity, uint sensed, float nervousness, bool heeds_jams) {
    RouteAhead ahead = freeRouteAhead(stage, position);
    float free = 1.0 - smoothstep(FORESIGHT_FREELY, FORESIGHT_NO_MORE, float(sensed));
    if (FORESIGHT_ENABLED && free > 0.0) {  // in a crowd, and so for most, one look will do
        vec2 lead = velocity * ((FORESIGHT_TIME + laterThanUsual()) * free * (1.0 - nervousness));
        RouteAhead soon = freeRouteAhead(stage, position + lead);
        if (abs(soon.remaining - ahead.remaining) <= length(lead) * FORESIGHT_SAME_WAY) {
            ahead = soon;
            // Nobody slows down sooner.
            ahead.remaining += laterThanUsual() * free * (1.0 - nervousness) * length(velocity);
        }
    }
    return heeds_jams ? heedingJams(stage, position, ahead) : ahead;
}
