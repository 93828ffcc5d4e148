// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/passes_table.h"
#include "cli/terminal/exit_codes.h"
#include "cli/terminal/say.h"
#include "sim/gl/context.h"

namespace throng::cli {
namespace {

nlohmann::ordered_json toJson(const gl::Device& device) {
    return {{"index", device.index},     {"name", device.name},         {"vendor", device.vendor},
            {"version", device.version}, {"platform", device.platform}, {"software", device.software},
            {"usable", device.usable},   {"problem", device.problem}};
}

void run(bool as_json) {
    const std::vector<gl::Device> devices = gl::listDevices();
    bool any_usable = false;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const gl::Device& device : devices) {
        any_usable = any_usable || device.usable;
        list.push_back(toJson(device));
        if (as_json) continue;
        if (device.usable)
            fmt::print("{}: {} ({}OpenGL {}, EGL {} platform)\n", device.index, device.name,
                       device.software ? "software, " : "", device.version, device.platform);
        else
            fmt::print("{}: not usable: {}\n", device.index, device.problem);
    }
    if (as_json) sayJson(list);
    if (any_usable) return;
    say(stderr,
        "throng: none of these devices can be used. On Debian, install the Mesa drivers: "
        "apt-get install libegl1 libopengl0 libgl1-mesa-dri (or the GPU vendor's driver with EGL).\n");
    throw Exit(kNoGraphics);
}

}  // namespace

void addDevices(CLI::App& app) {
    CLI::App* command = app.add_subcommand("devices", "List the devices that can run a bake (see --device)");
    auto as_json = std::make_shared<bool>(false);
    command->add_flag("--json", *as_json, "Print a JSON document");
    auto layout = std::make_shared<std::string>();
    CLI::Option* passes =
        command
            ->add_option(
                "--passes", *layout,
                "Instead: what the passes of a step read and write, for this layout or a small crowd")
            ->type_name("[LAYOUT]")
            ->expected(0, 1);
    command->footer("Example:\n  throng devices\n  throng devices --passes examples/station.json");
    command->callback([as_json, layout, passes] {
        if (passes->count() > 0)
            printPasses(*layout, *as_json);
        else
            run(*as_json);
    });
}

}  // namespace throng::cli
