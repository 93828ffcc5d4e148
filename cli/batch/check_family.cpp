// SPDX-License-Identifier: Apache-2.0
#include "cli/batch/check_family.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

#include "authoring/layout/json_document.h"
#include "cli/baking/load_layout.h"
#include "cli/batch/batch_plan.h"

namespace throng::cli {
namespace {

constexpr std::size_t kScenes = 4;  // evenly chosen, the first and the last among them

/// Tells what many scenarios have in common once, for the first of them.
class Gathered {
  public:
    explicit Gathered(authoring::Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    void add(const std::string& whose, const LoadAttempt& attempt) {
        for (const authoring::Diagnostic& entry : attempt.loaded.diagnostics.entries) {
            const std::string pointer = entry.where.pointer();
            if (!known_.insert(pointer + entry.message).second) continue;
            const std::string text =
                fmt::format("{}: {}{}{}", whose, pointer, pointer.empty() ? "" : ": ", entry.message);
            if (entry.severity == authoring::Severity::error)
                diagnostics_.error({}, text, entry.hint);
            else
                diagnostics_.warning({}, text, entry.hint);
        }
    }

  private:
    authoring::Diagnostics& diagnostics_;
    std::set<std::string> known_;
};

}  // namespace

bool isFamily(std::string_view text) {
    if (text.find("throng_family") == std::string_view::npos) return false;
    authoring::Diagnostics ignored;
    const authoring::JsonNode root = authoring::parseJson(text, ignored);
    return !ignored.hasErrors() && root.find("throng_family") && !root.find("throng");
}

FamilyCheck checkFamily(const std::string& path) {
    BatchPlan plan(path);
    FamilyCheck check;
    check.diagnostics.file = path;
    check.base_name = plan.family().base_name;
    check.scenarios = plan.scenarios().size();
    check.layouts_read = plan.tryLayouts();
    Gathered gathered(check.diagnostics);
    check.valid = true;
    const auto look = [&](const std::string& whose, const LoadAttempt& attempt) {
        gathered.add(whose, attempt);
        check.valid = check.valid && attempt.valid;
    };
    std::error_code none;
    const std::filesystem::path base = std::filesystem::path(path).parent_path() / plan.family().base_name;
    if (!plan.family().generator && std::filesystem::is_regular_file(base, none))
        look(fmt::format("base layout `{}`", plan.family().base_name), tryLoadLayout(base.string(), {}));
    authoring::GroundCache ground;
    check.scenes_built = std::min(kScenes, check.scenarios);
    for (std::size_t i = 0; i < check.scenes_built; ++i) {
        const std::size_t last = std::max<std::size_t>(check.scenes_built, 2) - 1;
        const std::size_t index = i * (check.scenarios - 1) / last;
        look(
            fmt::format("scenario {} ({})", index + 1, authoring::describe(plan.scenarios()[index].scenario)),
            tryReadLayout(plan.layoutText(index), path, {}, &ground));
    }
    return check;
}

}  // namespace throng::cli
