// SPDX-License-Identifier: Apache-2.0
// Where somebody goes next, when there may be a line to wait in. Needs the blocks Stages, WaitingLines and LinePoints.
//
// A line may be too short for all who wait. Those who find no place in it any more stand round its end, the later ones
// further out: anywhere in a disc will do that has room for all up to them. With one place for all of them they would
// press on it for as long as they wait.

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

/// The nearest point that will do for somebody.
vec2 nearestIn(PlaceInLine place, vec2 position) {
    vec2 offset = position - place.point;
    float size = length(offset);
    return size > place.reach ? place.point + offset * (place.reach / size) : position;
}
#endif

/// The stage somebody is at. In a line its point is the own place, or the end of the line for those who come.
Stage stageOf(uint number, uint ticket, vec2 position) {
    Stage stage = stages[number];
#ifdef WAITING_LINES
    if (stage.line == NO_INDEX) return stage;
    WaitingLine line = waiting_lines[stage.line];
    uint nth = (ticket == NO_INDEX ? line.given : ticket) - line.served;
    stage.point = nearestIn(placeInLine(line, nth), position);
#endif
    return stage;
}
