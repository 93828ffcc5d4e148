// SPDX-License-Identifier: Apache-2.0
#include "cli/baking/calibration_file.h"

#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/files/errors.h"
#include "base/files/hash.h"
#include "base/files/input_file.h"
#include "base/files/output_file.h"
#include "base/json_shape.h"
#include "base/text/printable.h"
#include "cli/terminal/say.h"

namespace throng::cli {
namespace {

/// Raised when shaders change so much that old measurements say nothing any more.
constexpr int kFormat = 1;

std::string identity(const gl::Device& device) {
    return device.name + " / " + device.version;
}

std::filesystem::path cacheFolder() {
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
        return std::filesystem::path(cache) / "throng";
    const char* home = std::getenv("HOME");
    return std::filesystem::path(home && *home ? home : "/tmp") / ".cache" / "throng";
}

nlohmann::ordered_json toJson(const sim::MethodCost& cost) {
    nlohmann::ordered_json json = {{"method", authoring::wordFor(cost.method)},
                                   {"base_ms", cost.base_ms},
                                   {"pixel_ns", cost.pixel_ns},
                                   {"site_ns", cost.site_ns},
                                   {"covered_ns", cost.covered_ns}};
    if (cost.method == sim::DiagramMethod::binned)
        json["gather"] = {{"block_width", cost.gather.block_width},
                          {"block_height", cost.gather.block_height},
                          {"bin_radii", cost.gather.bin_radii}};
    return json;
}

/// Looked at before it becomes a whole number: none holds what a file may say.
std::uint32_t blockSide(const nlohmann::json& json) {
    const auto side = json.get<double>();
    if (side != 1.0 && side != 2.0 && side != 4.0 && side != 8.0)
        throw std::runtime_error("blocks of a size that does not exist");
    return static_cast<std::uint32_t>(side);
}

sim::MethodCost fromJson(const nlohmann::json& json) {
    sim::MethodCost cost;
    const auto method = authoring::diagramMethodNamed(json.at("method").get<std::string>());
    if (!method || !authoring::isExact(*method) || *method == sim::DiagramMethod::automatic)
        throw std::runtime_error("a method that cannot be chosen");
    cost.method = *method;
    cost.base_ms = json.at("base_ms");
    cost.pixel_ns = json.at("pixel_ns");
    cost.site_ns = json.at("site_ns");
    cost.covered_ns = json.at("covered_ns");
    if (json.contains("gather")) {
        cost.gather.block_width = blockSide(json["gather"].at("block_width"));
        cost.gather.block_height = blockSide(json["gather"].at("block_height"));
        cost.gather.bin_radii = json["gather"].at("bin_radii");
        if (!(cost.gather.bin_radii >= 0.25f)) throw std::runtime_error("bins of a size that does not exist");
    }
    return cost;
}

}  // namespace

std::filesystem::path calibrationPath(const gl::Device& device) {
    return cacheFolder() / fmt::format("calibration-{}.json", hashText(identity(device)).substr(0, 16));
}

void saveCalibration(const gl::Device& device, const sim::CostModel& model) {
    nlohmann::ordered_json json = {{"throng-calibration", kFormat},
                                   {"version", THRONG_VERSION},
                                   {"device", identity(device)},
                                   {"costs", nlohmann::ordered_json::array()}};
    for (const sim::MethodCost& cost : model.costs)
        json["costs"].push_back(toJson(cost));
    const std::filesystem::path path = calibrationPath(device);
    try {
        makeFolder(path.parent_path());
        replaceFile(path, json.dump(2) + "\n");
    } catch (const OutputError& error) {
        throw OutputError(path, fmt::format("{}; XDG_CACHE_HOME names another folder", error.what()));
    }
}

std::optional<sim::CostModel> loadCalibration(const gl::Device& device) {
    const std::filesystem::path path = calibrationPath(device);
    std::error_code none;
    if (!std::filesystem::exists(path, none)) return std::nullopt;
    try {
        constexpr std::uint64_t kMostBytes = 1 << 20;
        const std::string text = readFile(path, kMostBytes);
        if (const char* problem = tooMuchIn(text)) throw std::runtime_error(problem);
        const nlohmann::json json = nlohmann::json::parse(text);
        if (json.at("throng-calibration") != kFormat || json.at("version") != THRONG_VERSION ||
            json.at("device") != identity(device))
            return std::nullopt;
        sim::CostModel model;
        model.device = json.at("device");
        for (const nlohmann::json& cost : json.at("costs"))
            model.costs.push_back(fromJson(cost));
        if (model.costs.empty()) return std::nullopt;
        return model;
    } catch (const std::exception& error) {
        say(stderr, "throng: warning: {} is passed over ({}); `throng calibrate` makes a new one\n",
            path.string(), shortened(printable(error.what())));
        return std::nullopt;
    }
}

sim::CostModel costsFor(const gl::Device& device) {
    return loadCalibration(device).value_or(device.software ? sim::CostModel::builtIn()
                                                            : sim::CostModel::builtInOfGpu());
}

}  // namespace throng::cli
