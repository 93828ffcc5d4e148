// SPDX-License-Identifier: Apache-2.0
// Who has its hands up lets them down before it walks off: it stands where it is for so long.
// Needs the blocks ParametersBlock and Stages, and the uniform steps_done.

const float LETTING_GO = 0.9;  // s; what recordings show in it: recording/pose_track.h

bool hasHandsUp(uint activity) { return activity >= ACTIVITY_CLAP && activity <= ACTIVITY_WAVE; }

/// Where it stands, so that there is nothing to let down.
bool goesOnWithHands(BehaviourState next) { return next.does == DOES_STAY && hasHandsUp(next.activity); }

/// @param stands whether it does what its state says; on the way there it has nothing to end
bool isLettingGo(inout Mind mind, BehaviourState doing, bool stands) {
    if (!stands || !hasHandsUp(doing.activity)) return false;
    if (mind.let_go == 0u) {
        mind.let_go = steps_done;
        stages[mind.first_stage].activity = ACTIVITY_STAND;
        stages[mind.first_stage + 1u].activity = ACTIVITY_STAND;
    }
    return float(steps_done - mind.let_go) * parameters.step_seconds < LETTING_GO;
}
