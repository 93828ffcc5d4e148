// SPDX-License-Identifier: Apache-2.0
// Where somebody goes next, when there may be a line to wait in. Needs the blocks Stages, WaitingLines and LinePoints.
//
// A line may be too short for all who wait. Those who find no place in it any more stand round its end, the later ones
// further out: anywhere in a disc will do that has room for all up to them. With one place for all of them they would
// press on it for as long as they wait. Those who come stop beside the line, not in it: between two who stand there
// already, whoever moves up would find its own place taken, and wedge itself in.

#include "shaders/shared/walls.glsl"

/// A place in a line, and how near to it will do, m.
struct PlaceInLine {
    vec2 point;
    float reach;
};

#ifdef WAITING_LINES
/// The place that is `nth` from the front.
PlaceInLine placeInLine(WaitingLine line, uint nth) {
    float left = float(nth) * line.spacing;
    for (uint i = line.first_point; i + 1u < line.first_point + line.point_count; ++i) {
        float piece = distance(line_points[i], line_points[i + 1u]);
        if (left <= piece)
            return PlaceInLine(mix(line_points[i], line_points[i + 1u], left / max(piece, 1.0e-6)), 0.0);
        left -= piece;
    }
    float reach = AT_REST_ENABLED ? AT_REST_ROUND_THE_END * sqrt(left * line.spacing) : 0.0;
    return PlaceInLine(line_points[line.first_point + line.point_count - 1u], reach);
}

/// The nearest point of a line.
vec2 nearestOf(WaitingLine line, vec2 point) {
    vec2 nearest = line_points[line.first_point];
    for (uint i = line.first_point; i + 1u < line.first_point + line.point_count; ++i) {
        vec2 a = line_points[i], b = line_points[i + 1u];
        vec2 there = a + alongSegment(point, a, b) * (b - a);
        if (distance(there, point) < distance(nearest, point)) nearest = there;
    }
    return nearest;
}

/// The nearest point that will do for somebody: round the end, beside the line.
vec2 nearestIn(WaitingLine line, PlaceInLine place, vec2 position) {
    vec2 offset = position - place.point;
    float size = length(offset);
    if (size <= place.reach) return position;
    vec2 point = place.point + offset * (place.reach / size);
    float clear = min(line.spacing, place.reach);
    vec2 beside = nearestOf(line, point);
    if (distance(point, beside) >= clear) return point;
    vec2 aside = position - beside;
    return beside + aside * min(1.0, clear / max(length(aside), 1.0e-6));
}
#endif

/// The stage somebody is at. In a line its point is the own place, or the end of the line for those who come.
Stage stageOf(uint number, uint ticket, vec2 position) {
    Stage stage = stages[number];
#ifdef WAITING_LINES
    if (stage.line == NO_INDEX) return stage;
    WaitingLine line = waiting_lines[stage.line];
    uint nth = (ticket == NO_INDEX ? line.given : ticket) - line.served;
    stage.point = nearestIn(line, placeInLine(line, nth), position);
#endif
    return stage;
}
