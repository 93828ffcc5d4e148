// SPDX-License-Identifier: Apache-2.0
// How vehicles are driven: the intelligent driver model (Treiber, Hennecke and Helbing 2000, equations 3 to 5).

/// m/s^2 that nobody brakes harder than.
const float HARDEST_BRAKING = 8.0;

/// m: the gap that a driver would like behind what is `closing` m/s slower.
float wishedGap(Vehicle self, float closing) {
    float braking = 2.0 * sqrt(self.most_acceleration * self.braking);
    return self.gap + max(self.speed * self.headway + self.speed * closing / braking, 0.0);
}

/// m/s^2, on an empty lane.
float freeAcceleration(Vehicle self) {
    float share = self.speed / self.wished_speed;
    return self.most_acceleration * (1.0 - share * share * share * share);
}

/// m/s^2: what something `gap` m ahead takes from that.
float brakingFor(Vehicle self, float gap, float closing) {
    float share = wishedGap(self, closing) / max(gap, 0.01);
    return self.most_acceleration * share * share;
}

/// m/s^2: what stopping within a distance takes.
float neededToStop(Vehicle self, float distance_left) {
    return self.speed * self.speed / (2.0 * max(distance_left, 0.1));
}
