// SPDX-License-Identifier: Apache-2.0
#include "cli/batch/batch_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "authoring/family/family_reader.h"
#include "authoring/family/named_files.h"
#include "authoring/layout/amounts.h"
#include "authoring/layout/layout_reader.h"
#include "base/files/hash.h"
#include "base/files/input_file.h"
#include "base/text/printable.h"
#include "cli/terminal/exit_codes.h"
#include "cli/terminal/failure.h"
#include "cli/terminal/say.h"

namespace throng::cli {
namespace {

using authoring::Json;

/// The parameters in the order of their names, so that the order of axes in the family does not matter.
std::string idOf(const authoring::Scenario& scenario) {
    auto parameters = scenario.parameters;
    std::sort(parameters.begin(), parameters.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    Json canonical = Json::object();
    for (const auto& [name, value] : parameters)
        canonical[name] = value;
    return hashText(canonical.dump());
}

double peopleOf(const authoring::Layout& layout) {
    double people = 0.0;
    for (const authoring::Flow& flow : layout.flows)
        people += authoring::peopleIn(flow, layout);
    for (const authoring::Formation& formation : layout.formations)
        people += authoring::peopleIn(formation);
    return people;
}

bool setsFiles(const authoring::Family& family) {
    return std::ranges::any_of(family.axes, [](const authoring::Axis& axis) {
        return std::ranges::any_of(axis.pointers, authoring::mayNameFiles) ||
               std::ranges::any_of(axis.cases, [](const auto& sets) {
                   return std::ranges::any_of(
                       sets, [](const auto& set) { return authoring::mayNameFiles(set.first); });
               });
    });
}

}  // namespace

bool isScenarioId(std::string_view text) {
    return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

BatchPlan::BatchPlan(const std::string& path) : path_(path) {
    const std::string text = readFile(path);
    authoring::Diagnostics diagnostics;
    diagnostics.file = path;
    auto family = authoring::readFamily(text, std::filesystem::path(path).parent_path(), diagnostics);
    std::vector<authoring::Scenario> scenarios;
    if (family) try {
            scenarios = authoring::planFamily(*family);
        } catch (const authoring::PlanError& error) {
            diagnostics.error(error.where, error.what());
            family.reset();
        }
    for (const authoring::Diagnostic& entry : diagnostics.entries)
        say(stderr, "{}\n", authoring::formatDiagnostic(entry, path, text));
    if (!family) throw Exit(kInvalidInput, "the family is not valid", diagnosticsJson(diagnostics));
    family_ = std::move(*family);
    if (family_.name.empty()) family_.name = printable(std::filesystem::path(path).stem().string());
    for (authoring::Scenario& scenario : scenarios) {
        std::string id = idOf(scenario);
        scenarios_.push_back({std::move(id), std::move(scenario)});
    }
    Json whole = Json::parse(text);
    whole["name"] = family_.name;
    if (whole.contains("base")) whole["base"] = family_.base;
    if (setsFiles(family_)) whole["folder"] = family_.folder;
    whole.erase("$schema");
    self_contained_ = whole.dump(1) + "\n";
}

std::string BatchPlan::layoutText(std::size_t index) const {
    Json layout = authoring::composeLayout(family_, scenarios_.at(index).scenario);
    if (!layout.contains("name")) layout["name"] = family_.name;
    return layout.dump(1) + "\n";
}

std::string BatchPlan::inputHash(const std::string& layout_text) const {
    const authoring::Family::Bake& bake = family_.bake;
    const std::string formats =
        bake.formats == StreamFormats::standard() ? "" : "\nstreams as " + wordsOf(bake.formats);
    return hashText(fmt::format("{}\n{} {} {} {}{}{}", layout_text, bake.keep, bake.gltf,
                                identityOf(bake.streams), bake.diagrams, filesOf(layout_text), formats));
}

/// What the files hold that a layout names: a result is out of date when they change.
std::string BatchPlan::filesOf(const std::string& layout_text) const {
    if (layout_text.find("\"file\"") == std::string::npos) return "";
    const Json layout = Json::parse(layout_text, nullptr, false);
    std::string hashes;
    for (const auto& pointer : authoring::namedFiles(layout)) {
        const std::string file = layout.at(pointer);
        const auto [known, is_new] = files_.try_emplace(file);
        if (is_new) {
            std::error_code none;
            std::filesystem::path path = file;
            if (std::filesystem::is_directory(path, none)) path /= "bake.json";
            if (std::filesystem::is_regular_file(path, none)) known->second = "\n" + hashFile(path).xxh3;
        }
        hashes += known->second;
    }
    return hashes;
}

std::size_t BatchPlan::tryLayouts() {
    constexpr std::size_t kMost = 4000;
    constexpr std::size_t kMostBytes = std::size_t{20} << 20;  // of them together: they take time
    constexpr std::size_t kMostPrinted = 3;
    const std::size_t tried =
        std::min({kMost, scenarios_.size(), 8 + kMostBytes / (self_contained_.size() + 1)});
    std::size_t wrong = 0;
    authoring::Diagnostics told;  // the same for --json
    told.file = path_;
    for (std::size_t i = 0; i < tried; ++i) {
        const std::size_t index = i * scenarios_.size() / tried;
        std::string problem;
        try {
            const std::string text = layoutText(index);
            authoring::Diagnostics diagnostics;
            const auto layout = authoring::readLayout(text, {}, diagnostics);
            if (layout) addLoad(*layout, static_cast<double>(scenarios_.size()) / static_cast<double>(tried));
            for (const authoring::Diagnostic& entry : diagnostics.entries)
                if (entry.severity == authoring::Severity::error)
                    problem += fmt::format("\n  {}: {}{}", entry.where.pointer(), entry.message,
                                           entry.hint.empty() ? "" : "\n    hint: " + entry.hint);
        } catch (const std::invalid_argument& error) {
            problem = std::string("\n  ") + error.what();
        }
        if (!problem.empty() && ++wrong <= kMostPrinted)
            say(stderr, "{}: error: scenario {} ({}) is no valid layout:{}\n", path_, index + 1,
                authoring::describe(scenarios_[index].scenario), problem);
        if (!problem.empty())
            told.error({}, fmt::format("scenario {} ({}) is no valid layout:{}", index + 1,
                                       authoring::describe(scenarios_[index].scenario), problem));
    }
    if (wrong > kMostPrinted)
        say(stderr, "{}: {} scenarios more are no valid layouts\n", path_, wrong - kMostPrinted);
    if (wrong > 0)
        throw Exit(kInvalidInput, fmt::format("{} of {} scenarios tried are no valid layouts", wrong, tried),
                   diagnosticsJson(told));
    return tried;
}

void BatchPlan::addLoad(const authoring::Layout& layout, double share) {
    const authoring::SimulationSettings& settings = layout.simulation;
    const double frames = std::max(1.0, std::round(settings.duration * settings.fps));
    const double steps = (frames + std::round(settings.warmup * settings.fps)) * settings.substeps;
    const double people = peopleOf(layout);
    const double bytes_per_stream = family_.bake.formats.bytes();
    const auto streams = static_cast<double>(countOf(streamsOf(false, family_.bake.streams)));
    load_.steps += share * steps;
    load_.people_steps += share * steps * people;
    load_.bytes +=
        share * (family_.bake.keep ? frames * people * bytes_per_stream * streams + 20'000.0 : 0.0);
    load_.largest_people = std::max(load_.largest_people, people);
}

}  // namespace throng::cli
