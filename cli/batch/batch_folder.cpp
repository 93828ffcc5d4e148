// SPDX-License-Identifier: Apache-2.0
#include "cli/batch/batch_folder.h"

#include <set>

#include "base/build_name.h"
#include "base/files/input_file.h"
#include "base/files/output_file.h"
#include "base/json_shape.h"
#include "io/verify_bake.h"

namespace throng::cli {
namespace fs = std::filesystem;
using nlohmann::ordered_json;

void BatchFolder::begin(const BatchPlan& plan) const {
    std::error_code ignored;
    if (fs::exists(root_, ignored) && !fs::is_empty(root_, ignored) && !fs::exists(familyFile(), ignored))
        throw OutputError(root_, "is there and is no batch (no family.json inside); give another name");
    for (const char* name : {"bakes", "results", "logs"})
        makeFolder(root_ / name);
    if (!fs::exists(familyFile()) || readFile(familyFile()) != plan.selfContained())
        replaceFile(familyFile(), plan.selfContained());
}

std::optional<ordered_json> BatchFolder::readResult(const std::string& id) const {
    std::error_code ignored;
    if (!fs::exists(result(id), ignored)) return std::nullopt;
    constexpr std::uint64_t kMostBytes = std::uint64_t{16} << 20;
    const std::string text = readFile(result(id), kMostBytes);
    if (tooMuchIn(text)) return std::nullopt;
    ordered_json json = ordered_json::parse(text, nullptr, false);
    const bool understood = json.is_object() && json.value("throng_result", ordered_json()) == 1 &&
                            json.contains("status") && json.contains("input");
    return understood ? std::optional(std::move(json)) : std::nullopt;
}

void BatchFolder::writeResult(const std::string& id, const ordered_json& content) const {
    replaceFile(result(id), content.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

void BatchFolder::writeLog(const std::string& id, const std::string& text) const {
    replaceFile(log(id), text);
}

BatchStanding standingOf(const BatchPlan& plan, const BatchFolder& folder, bool again,
                         const std::function<bool(std::size_t)>& mine) {
    BatchStanding standing;
    std::set<std::string> known;
    std::error_code ignored;
    const bool keeps = plan.family().bake.keep;
    for (std::size_t i = 0; i < plan.scenarios().size(); ++i) {
        const std::string& id = plan.scenarios()[i].id;
        known.insert(id + ".json");
        const std::optional<ordered_json> result = folder.readResult(id);
        if (result && !again) {
            std::string input;
            try {
                input = plan.inputHash(plan.layoutText(i));
            } catch (const std::invalid_argument&) {
                // Its layout cannot be made: it fails again, and says so.
            }
            const bool fits = result->at("input") == input;
            const bool is_ours = result->value("build", ordered_json()) == buildName();
            const bool well = result->at("status") == "ok";
            const bool has_bake = fs::exists(folder.bake(id), ignored);
            const bool is_sound =
                !keeps || (has_bake && (!mine(i) || io::verifyBake(folder.bake(id)).problems.empty()));
            if (fits && is_ours && well && is_sound) {
                ++standing.done;
                continue;
            }
            if (fits && is_ours && well && has_bake) standing.damaged.push_back(i);
            standing.other_build += well && fits && !is_ours ? 1 : 0;
            standing.failed_before += !well ? 1 : 0;
            standing.out_of_date += well && !fits ? 1 : 0;
        }
        standing.open.push_back(i);
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.root() / "results", ignored)) {
        const std::string name = entry.path().filename().string();
        if (!name.ends_with(".json") || known.contains(name)) continue;
        // Whatever else somebody has put there is none of ours.
        const std::string id = name.substr(0, name.size() - std::string_view(".json").size());
        if (isScenarioId(id)) standing.foreign.push_back(id);
    }
    return standing;
}

}  // namespace throng::cli
