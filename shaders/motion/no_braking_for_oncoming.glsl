// SPDX-License-Identifier: Apache-2.0
// Nobody brakes for oncoming people; one swerves. Two who walk straight at each other only change their ways and keep
// their speeds; those who cross change both (Huber et al. 2014). A swerve ends behind somebody who goes the same way:
// lanes form by themselves.

/// How much somebody comes the other way, 0 to 1, by the cosine between the two ways.
float oncomingOf(float alike) {
    return smoothstep(NO_BRAKING_FOR_ONCOMING_BEGINS, NO_BRAKING_FOR_ONCOMING_COMPLETE, -alike);
}

/// How much of the braking for such a person is left out, 0 to 1.
float unbraked(float oncoming) { return NO_BRAKING_FOR_ONCOMING_ENABLED ? oncoming : 0.0; }
