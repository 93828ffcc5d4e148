// SPDX-License-Identifier: Apache-2.0
#include "sim/benchmarks/calibration.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

namespace throng::sim {
namespace {

constexpr std::size_t kTerms = 4;
using Terms = std::array<double, kTerms>;

/// What the terms of MethodCost multiply.
Terms termsOf(const DiagramLoad& load) {
    return {1.0, 1.0e-6 * load.pixels, 1.0e-6 * load.sites, 1.0e-6 * load.sites * load.radius * load.radius};
}

/// Solves the normal equations for the terms chosen by the bits of `active`. @returns false when singular
bool solve(const std::vector<CalibrationSample>& samples, unsigned active, Terms& solution) {
    std::array<std::array<double, kTerms + 1>, kTerms> rows{};
    for (const CalibrationSample& sample : samples) {
        const Terms terms = termsOf(sample.load);
        const double weight = 1.0 / (sample.milliseconds * sample.milliseconds);
        for (std::size_t i = 0; i < kTerms; ++i) {
            for (std::size_t j = 0; j < kTerms; ++j)
                rows[i][j] += weight * terms[i] * terms[j];
            rows[i][kTerms] += weight * terms[i] * sample.milliseconds;
        }
    }
    for (std::size_t i = 0; i < kTerms; ++i) {
        if (active & (1u << i)) continue;
        for (std::size_t j = 0; j < kTerms; ++j)
            rows[i][j] = rows[j][i] = 0.0;
        rows[i][i] = 1.0;
        rows[i][kTerms] = 0.0;
    }
    // Gauss-Jordan with the largest pivot.
    for (std::size_t column = 0; column < kTerms; ++column) {
        std::size_t pivot = column;
        for (std::size_t row = column + 1; row < kTerms; ++row)
            if (std::abs(rows[row][column]) > std::abs(rows[pivot][column])) pivot = row;
        if (std::abs(rows[pivot][column]) < 1.0e-12) return false;
        std::swap(rows[column], rows[pivot]);
        for (std::size_t row = 0; row < kTerms; ++row) {
            if (row == column) continue;
            const double factor = rows[row][column] / rows[column][column];
            for (std::size_t k = column; k <= kTerms; ++k)
                rows[row][k] -= factor * rows[column][k];
        }
    }
    for (std::size_t i = 0; i < kTerms; ++i)
        solution[i] = rows[i][kTerms] / rows[i][i];
    return true;
}

double relativeError(const std::vector<CalibrationSample>& samples, const Terms& solution) {
    double error = 0.0;
    for (const CalibrationSample& sample : samples) {
        const Terms terms = termsOf(sample.load);
        double predicted = 0.0;
        for (std::size_t i = 0; i < kTerms; ++i)
            predicted += terms[i] * solution[i];
        const double relative = predicted / sample.milliseconds - 1.0;
        error += relative * relative;
    }
    return error;
}

}  // namespace

// With four terms, all sixteen choices of which may be above zero can be tried.
MethodCost fitCost(DiagramMethod method, const GatherShape& gather,
                   const std::vector<CalibrationSample>& samples) {
    Terms best{};
    double least = std::numeric_limits<double>::infinity();
    for (unsigned active = 1; active < (1u << kTerms); ++active) {
        Terms solution{};
        if (!solve(samples, active, solution)) continue;
        bool negative = false;
        for (const double term : solution)
            negative = negative || term < 0.0;
        const double error = relativeError(samples, solution);
        if (negative || !(error < least)) continue;
        least = error;
        best = solution;
    }
    return {method, gather, best[0], best[1], best[2], best[3]};
}

std::vector<DiagramContestant> calibrationContestants() {
    std::vector<DiagramContestant> contestants;
    for (const DiagramMethod method :
         {DiagramMethod::gradient1, DiagramMethod::gradient2, DiagramMethod::per_site})
        contestants.push_back({std::string(authoring::wordFor(method)), method, 16, {}});
    for (const GatherShape& shape :
         {GatherShape{8, 4, 1.5f}, GatherShape{8, 4, 2.0f}, GatherShape{4, 4, 1.0f}, GatherShape{4, 4, 2.0f},
          GatherShape{4, 2, 1.0f}, GatherShape{2, 2, 1.0f}})
        contestants.push_back({fmt::format("binned {}x{}, bins of {} radii", shape.block_width,
                                           shape.block_height, shape.bin_radii),
                               DiagramMethod::binned, 16, shape});
    return contestants;
}

CostModel calibrate(const gl::ShaderLibrary& library, const gl::Timer& timer, const std::string& device,
                    int rounds, const std::function<void(double)>& progress) {
    const std::vector<DiagramContestant> contestants = calibrationContestants();
    const std::vector<DiagramCase> cases = {{64, 4, 512},     {1024, 8, 512},   {16384, 2, 512},
                                            {256, 8, 1024},   {4096, 8, 1024},  {4096, 16, 1024},
                                            {16384, 8, 1024}, {65536, 4, 1024}, {262144, 2, 1024},
                                            {1024, 8, 2048},  {16384, 4, 2048}, {65536, 8, 2048}};
    DiagramBenchmark benchmark;
    benchmark.rounds = rounds;
    std::vector<std::vector<CalibrationSample>> samples(contestants.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const DiagramCase& setup = cases[i];
        const auto timings = benchmark.run(library, timer, setup, contestants);
        const DiagramLoad load{static_cast<double>(setup.sites), setup.radius,
                               static_cast<double>(setup.side) * setup.side};
        for (std::size_t j = 0; j < contestants.size(); ++j)
            if (timings[j]) samples[j].push_back({load, timings[j]->median_ms});
        if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(cases.size()));
    }
    CostModel model;
    model.device = device;
    for (std::size_t j = 0; j < contestants.size(); ++j)
        model.costs.push_back(fitCost(contestants[j].method, contestants[j].gather, samples[j]));
    return model;
}

}  // namespace throng::sim
