// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "authoring/family/family_reader.h"
#include "authoring/layout/layout_reader.h"
#include "authoring/overrides/overrides_reader.h"
#include "cli/commands.h"
#include "cli/schemas/schemas.h"

namespace throng::cli {
namespace {

/// A schema and the flag that asks for it; layouts need none.
struct Entry {
    const char* flag;
    const char* meaning;
    std::string_view (*schema)();
};

constexpr Entry kEntries[] = {
    {"--family", "That of families of scenarios (`throng batch`)", authoring::familySchema},
    {"--overrides", "That of changes to single people (`throng apply`)", authoring::overridesSchema},
    {"--bake", "That of bake.json", bakeSchema},
    {"--measure", "That of what `throng measure --json` prints", measureSchema},
    {"--result", "That of results/ID.json in a batch", resultSchema},
    {"--batch", "That of what `throng batch --json` prints", batchSchema},
};

}  // namespace

void addSchema(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "schema",
        "Print the JSON Schema of layouts, or of another format, for editors that complete and check");
    auto asked = std::make_shared<std::array<bool, std::size(kEntries)>>();
    std::vector<CLI::Option*> flags;
    for (std::size_t i = 0; i < std::size(kEntries); ++i)
        flags.push_back(command->add_flag(kEntries[i].flag, (*asked)[i], kEntries[i].meaning));
    command->add_flag("--json")->description("What it prints is JSON anyway");
    command->footer("Example:\n  throng schema > throng-layout.schema.json");
    command->callback([asked] {
        if (std::ranges::count(*asked, true) > 1)
            throw CLI::ValidationError("schema", "prints one schema: give one flag");
        const auto found = std::ranges::find(*asked, true);
        fmt::print("{}", found == asked->end() ? authoring::layoutSchema()
                                               : kEntries[found - asked->begin()].schema());
    });
}

}  // namespace throng::cli
