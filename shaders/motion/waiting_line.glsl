// SPDX-License-Identifier: Apache-2.0
// Where somebody goes next, when there may be a line to wait in. Needs the blocks Stages, WaitingLines and LinePoints.

/// The place in a line that is `nth` from its front. Who finds no place any more waits round the end.
vec2 placeInLine(WaitingLine line, uint nth) {
    float left = float(nth) * line.spacing;
    for (uint i = line.first_point; i + 1u < line.first_point + line.point_count; ++i) {
        float piece = distance(line_points[i], line_points[i + 1u]);
        if (left <= piece) return mix(line_points[i], line_points[i + 1u], left / max(piece, 1.0e-6));
        left -= piece;
    }
    return line_points[line.first_point + line.point_count - 1u];
}

/// The stage somebody is at. In a line its point is the own place, or the end of the line for those who come.
Stage stageOf(uint number, uint ticket) {
    Stage stage = stages[number];
    if (stage.line == NO_INDEX) return stage;
    WaitingLine line = waiting_lines[stage.line];
    stage.point = placeInLine(line, (ticket == NO_INDEX ? line.given : ticket) - line.served);
    return stage;
}
