// SPDX-License-Identifier: Apache-2.0
// The folder of a bake, as `throng info` reads it, and its table of people.
#include <filesystem>

#include "io/agent_rows.h"
#include "io/bake_info.h"
#include "io/crowd_reader.h"
#include "io/overrides/agent_table_edit.h"
#include "io/verify_bake.h"
#include "support/bake_input.h"

using namespace throng;

THRONG_FUZZ_BAKE()

void fuzz::readOne(std::string_view input) {
    const std::filesystem::path folder = putBake(input);
    const io::Bake bake = io::loadBake(folder);
    static_cast<void>(io::infoText(bake));
    static_cast<void>(
        io::infoJson(bake).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    static_cast<void>(io::verifyBake(folder));
    static_cast<void>(io::groupsOf(io::loadAgentRows(bake)));
    const io::CrowdReader crowd(bake);
    static_cast<void>(io::loadEntrants(crowd));
    static_cast<void>(io::AgentTableEdit(bake).text());
}
