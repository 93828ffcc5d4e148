// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

/// Each command adds itself to the application and runs as CLI11's callback. A new one is a file and a line
/// here and in main.
namespace throng::cli {

void addBake(CLI::App& app);
void addApply(CLI::App& app);
void addConvert(CLI::App& app);
void addCheck(CLI::App& app);
void addInfo(CLI::App& app);
void addPreview(CLI::App& app);
void addSchema(CLI::App& app);
void addDevices(CLI::App& app);
void addCalibrate(CLI::App& app);
void addBench(CLI::App& app);
void addMeasure(CLI::App& app);
void addCompare(CLI::App& app);
void addScenarios(CLI::App& app);
void addGenerate(CLI::App& app);
void addBatch(CLI::App& app);
void addReport(CLI::App& app);
void addVerify(CLI::App& app);
void addWatch(CLI::App& app);
void addCompletions(CLI::App& app);
void addManual(CLI::App& app);
void addBatchQuery(CLI::App& batch);

}  // namespace throng::cli
