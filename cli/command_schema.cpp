// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "authoring/family/family_reader.h"
#include "authoring/layout/layout_reader.h"
#include "authoring/overrides/overrides_reader.h"
#include "cli/commands.h"

namespace throng::cli {

void addSchema(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("schema", "Print the JSON Schema of layouts, for editors that complete and check");
    auto family = std::make_shared<bool>(false), overrides = std::make_shared<bool>(false);
    CLI::Option* of_families =
        command->add_flag("--family", *family, "That of families of scenarios (`throng batch`)");
    command->add_flag("--overrides", *overrides, "That of changes to single people (`throng apply`)")
        ->excludes(of_families);
    command->add_flag("--json")->description("What it prints is JSON anyway");
    command->footer("Example:\n  throng schema > throng-layout.schema.json");
    command->callback([family, overrides] {
        fmt::print("{}", *family      ? authoring::familySchema()
                         : *overrides ? authoring::overridesSchema()
                                      : authoring::layoutSchema());
    });
}

}  // namespace throng::cli
