// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "authoring/cli/commands.h"
#include "authoring/family/family_reader.h"
#include "authoring/layout/layout_reader.h"

namespace throng::cli {

void addSchema(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("schema", "Print the JSON Schema of layouts, for editors that complete and check");
    auto family = std::make_shared<bool>(false);
    command->add_flag("--family", *family, "That of families of scenarios (`throng batch`)");
    command->footer("Example:\n  throng schema > throng-layout.schema.json");
    command->callback(
        [family] { fmt::print("{}", *family ? authoring::familySchema() : authoring::layoutSchema()); });
}

}  // namespace throng::cli
