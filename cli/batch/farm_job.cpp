// SPDX-License-Identifier: Apache-2.0
#include "cli/batch/farm_job.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace throng::cli {
namespace {

using nlohmann::ordered_json;

std::string openJobDescription(const BatchPlan& plan, const std::string& family, const std::string& output,
                               std::size_t parts) {
    const auto step = [&](const std::vector<std::string>& more) {
        ordered_json arguments = {"batch", "{{RawParam.Family}}", "-o", "{{RawParam.Output}}", "-q"};
        for (const std::string& word : more)
            arguments.push_back(word);
        return ordered_json{
            {"actions",
             {{"onRun",
               {{"command", "{{Param.Throng}}"},
                {"args", arguments},
                {"cancelation", {{"mode", "NOTIFY_THEN_TERMINATE"}, {"notifyPeriodInSeconds", 30}}}}}}}};
    };
    ordered_json job;
    job["specificationVersion"] = "jobtemplate-2023-09";
    job["name"] = jobName(plan.family().name);
    job["parameterDefinitions"] =
        ordered_json::array({{{"name", "Throng"},
                              {"type", "STRING"},
                              {"default", "throng"},
                              {"description", "The program, as the nodes find it"}},
                             {{"name", "Family"},
                              {"type", "STRING"},
                              {"default", family},
                              {"description", "The family file, on a shared folder"}},
                             {{"name", "Output"},
                              {"type", "STRING"},
                              {"default", output},
                              {"description", "The batch's folder, shared"}}});
    job["steps"] = ordered_json::array(
        {{{"name", "Bake"},
          {"parameterSpace",
           {{"taskParameterDefinitions",
             ordered_json::array(
                 {{{"name", "Part"}, {"type", "INT"}, {"range", fmt::format("0-{}", parts - 1)}}})}}},
          {"script", step({"--shard", fmt::format("{{{{Task.Param.Part}}}}/{}", parts)})}},
         {{"name", "Gather"},
          {"dependencies", ordered_json::array({{{"dependsOn", "Bake"}}})},
          {"script", step({"--collect"})}}});
    return job.dump(2, ' ', true, ordered_json::error_handler_t::replace) + "\n";
}

std::string flamencoJobType(const BatchPlan& plan, const std::string& family, const std::string& output,
                            std::size_t parts) {
    const auto text = [](const std::string& value) {
        return ordered_json(value).dump(-1, ' ', true, ordered_json::error_handler_t::replace);
    };
    return fmt::format(R"js(// A job type for Flamenco 3: put it into the manager's `scripts` folder.
const JOB_TYPE = {{
    label: {label},
    settings: [
        {{ key: "throng", type: "string", required: true, default: "throng",
           description: "The program, as the workers find it" }},
        {{ key: "family", type: "string", required: true, default: {family},
           description: "The family file, on shared storage" }},
        {{ key: "output", type: "string", required: true, default: {output},
           description: "The batch's folder, on shared storage" }},
        {{ key: "parts", type: "int32", required: true, default: {parts},
           description: "Tasks to cut the batch into" }},
    ]
}};

function compileJob(job) {{
    const settings = job.settings;
    const batch = ["batch", settings.family, "-o", settings.output, "-q"];
    const gather = author.Task("gather", "misc");
    gather.addCommand(author.Command("exec", {{ exe: settings.throng, args: batch.concat(["--collect"]) }}));
    for (let part = 0; part < settings.parts; part++) {{
        const task = author.Task("bake-" + part, "misc");
        task.addCommand(author.Command("exec", {{
            exe: settings.throng,
            args: batch.concat(["--shard", part + "/" + settings.parts]),
        }}));
        gather.addDependency(task);
        job.addTask(task);
    }}
    job.addTask(gather);
}}
)js",
                       fmt::arg("label", text(jobName(plan.family().name))), fmt::arg("family", text(family)),
                       fmt::arg("output", text(output)), fmt::arg("parts", parts));
}

}  // namespace

std::string jobName(std::string_view name) {
    constexpr std::size_t kLongest = 100;
    constexpr std::string_view kAlso = " ._-";
    std::string result = "throng ";
    for (const char letter : name.substr(0, kLongest)) {
        const bool plain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                           (letter >= '0' && letter <= '9') || kAlso.find(letter) != std::string_view::npos;
        result += plain ? letter : '_';
    }
    return result;
}

std::size_t partsFor(std::size_t scenarios) {
    constexpr std::size_t kEach = 50;  // starting a task takes a second or more
    return std::clamp<std::size_t>((scenarios + kEach - 1) / kEach, 1, 1000);
}

std::string farmJob(const std::string& manager, const BatchPlan& plan, const std::string& family_path,
                    const BatchFolder& folder, std::size_t parts) {
    const std::string family = std::filesystem::absolute(family_path).string();
    const std::string output = std::filesystem::absolute(folder.root()).string();
    return manager == "openjd" ? openJobDescription(plan, family, output, parts)
                               : flamencoJobType(plan, family, output, parts);
}

}  // namespace throng::cli
