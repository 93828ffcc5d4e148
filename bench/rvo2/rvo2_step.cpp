// SPDX-License-Identifier: Apache-2.0
// Steps a crowd by RVO2 for every line of the standard input and prints how long that took, as `throng bench
// step` does: so both can be timed in turn. The crowd is the one that `throng bench step --crowd` writes.
// Everybody keeps the velocity that it prefers at first, so that setting it is not timed.
//
// Usage: rvo2_step CROWD.csv
#include <RVOSimulator.h>
#include <Vector2.h>
#include <omp.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

namespace {

constexpr float kStep = 1.0f / 30.0f;  // s
constexpr float kSight = 3.3f;         // m: what Throng's rays reach (radius 0.3 m, six samples 0.6 m apart)
constexpr std::size_t kNeighbours = 10;
constexpr float kHorizon = 2.0f;  // s

/// One line of the table: x, y, goal_x, goal_y, speed, radius.
void addAgent(RVO::RVOSimulator& simulator, std::string line) {
    for (char& letter : line)
        if (letter == ',') letter = ' ';
    std::istringstream fields(line);
    float x, y, goal_x, goal_y, speed, radius;
    if (!(fields >> x >> y >> goal_x >> goal_y >> speed >> radius))
        throw std::runtime_error("bad line: " + line);
    const float away_x = goal_x - x, away_y = goal_y - y;
    const float size = std::max(std::hypot(away_x, away_y), 1.0e-6f);
    const std::size_t agent = simulator.addAgent(RVO::Vector2(x, y), kSight, kNeighbours, kHorizon, kHorizon,
                                                 radius, 1.5f * speed, RVO::Vector2());
    simulator.setAgentPrefVelocity(agent, RVO::Vector2(away_x / size * speed, away_y / size * speed));
}

void readCrowd(RVO::RVOSimulator& simulator, const char* path) {
    std::ifstream table(path);
    std::string line;
    if (!std::getline(table, line)) throw std::runtime_error(std::string("cannot read ") + path);
    while (std::getline(table, line))
        addAgent(simulator, line);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: %s CROWD.csv\n", argv[0]);
        return 2;
    }
    RVO::RVOSimulator simulator;
    simulator.setTimeStep(kStep);
    readCrowd(simulator, argv[1]);
    simulator.doStep();
    std::printf("%d threads\n", omp_get_max_threads());
    std::fflush(stdout);
    for (std::string line; std::getline(std::cin, line);) {
        const auto start = std::chrono::steady_clock::now();
        simulator.doStep();
        const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
        std::printf("%.4f\n", time.count());
        std::fflush(stdout);
    }
    return 0;
}
