// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/terminal/exit_codes.h"
#include "cli/terminal/say.h"
#include "io/bake_info.h"
#include "io/verify_bake.h"

namespace throng::cli {
namespace {

struct InfoOptions {
    std::string bake;
    bool verify = false;
    bool json = false;
};

void runInfo(const InfoOptions& options) {
    const io::Bake bake = io::loadBake(options.bake);
    io::Verification found;
    if (options.verify) found = io::verifyBake(options.bake);
    if (options.json) {
        nlohmann::ordered_json document = io::infoJson(bake);
        if (options.verify) {
            document["problems"] = nlohmann::ordered_json::array();
            for (const io::BakeProblem& problem : found.problems)
                document["problems"].push_back({{"path", problem.path}, {"message", problem.message}});
        }
        sayJson(document);
    } else {
        say(stdout, "{}", io::infoText(bake));
        for (const io::BakeProblem& problem : found.problems)
            say(stderr, "{}: {}\n", problem.path, problem.message);
        if (options.verify && found.isWhole())
            say(stdout, "verified: all {} files are as they were written\n", bake.files.size());
    }
    if (!found.problems.empty()) throw Exit(kInvalidInput);
}

}  // namespace

void addInfo(CLI::App& app) {
    CLI::App* command = app.add_subcommand("info", "Say what a bake holds and what became of everybody");
    auto options = std::make_shared<InfoOptions>();
    command->add_option("bake", options->bake, "A bake's folder, or its bake.json")->required();
    command->add_flag("--verify", options->verify,
                      "Also compare every file with its checksum, as `throng verify`");
    command->add_flag("--json", options->json, "Print a JSON document");
    command->footer("Example:\n  throng info bakes/intersection --verify");
    command->callback([options] { runInfo(*options); });
}

}  // namespace throng::cli
