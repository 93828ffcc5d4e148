// SPDX-License-Identifier: Apache-2.0
// Goals that move: away from something, and behind somebody. Both look for a way that is clear of walls.
// Needs the block States, shaders/shared/alive.glsl and shaders/behaviour/clear_way.glsl and spots.glsl.

/// The direction nearest to this one in which some metres are clear; zero where all round is a wall.
vec2 clearDirection(Seeker seeker, vec2 direction, float reach) {
    const int MOST = 5;
    const float TURN = 0.5236;  // rad
    // Rather to the side to which one already goes.
    float side = direction.x * seeker.ahead.y - direction.y * seeker.ahead.x < 0.0 ? -1.0 : 1.0;
    for (int i = 0; i <= 2 * MOST; ++i) {
        float angle = TURN * float((i + 1) / 2) * (i % 2 == 1 ? side : -side);
        vec2 turned = mat2(cos(angle), sin(angle), -sin(angle), cos(angle)) * direction;
        if (wayIsClear(seeker.position, seeker.position + reach * turned, seeker.radius)) return turned;
    }
    return vec2(0.0);
}

/// Whom somebody follows, or flees from: the nearest who is there. It looks round again now and then.
void chooseLeader(Seeker seeker, inout Mind mind, BehaviourState doing) {
    bool gone = mind.followed == NO_INDEX || !isAlive(states[mind.followed].status);
    if (!gone && !looksRoundAgain(seeker)) return;
    float least = 1.0e30;
    mind.followed = NO_INDEX;
    for (uint row = doing.first_row; row < doing.first_row + doing.row_count; ++row) {
        if (row == seeker.row || states[row].spawn_step == NO_INDEX) continue;
        float away = distance(states[row].position, seeker.position);
        if (away >= least || !isAlive(states[row].status)) continue;
        least = away;
        mind.followed = row;
    }
}

vec2 awayFromDanger(Seeker seeker, inout Mind mind, BehaviourState doing) {
    const float REACH = 4.0;  // m
    vec2 danger = doing.from;
    if (doing.row_count > 0u) {
        chooseLeader(seeker, mind, doing);
        mind.flags |= MIND_IS_SAFE;
        if (mind.followed == NO_INDEX) return seeker.position;
        danger = states[mind.followed].position;
    }
    vec2 offset = seeker.position - danger;
    float size = length(offset);
    if (size >= doing.distance) return seeker.position;
    mind.flags &= ~MIND_IS_SAFE;
    return seeker.position + REACH * clearDirection(seeker, size > 1.0e-3 ? offset / size : seeker.ahead, REACH);
}

vec2 behindLeader(Seeker seeker, Mind mind, BehaviourState doing) {
    const float REACH = 3.0;  // m
    if (mind.followed == NO_INDEX) return seeker.position;
    vec2 offset = states[mind.followed].position - seeker.position;
    float size = length(offset);
    if (size <= doing.distance) return seeker.position;
    vec2 direction = offset / size;
    if (wayIsClear(seeker.position, seeker.position + direction * (size - 0.5), seeker.radius))
        return seeker.position + direction * (size - doing.distance);
    return seeker.position + REACH * clearDirection(seeker, direction, REACH);
}
