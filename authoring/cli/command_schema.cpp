// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "authoring/cli/commands.h"
#include "authoring/layout/layout_reader.h"

namespace throng::cli {

void addSchema(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("schema", "Print the JSON Schema of layouts, for editors that complete and check");
    command->footer("Example:\n  throng schema > throng-layout.schema.json");
    command->callback([] { fmt::print("{}", authoring::layoutSchema()); });
}

}  // namespace throng::cli
