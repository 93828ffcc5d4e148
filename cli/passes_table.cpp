// SPDX-License-Identifier: Apache-2.0
#include "cli/passes_table.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "cli/baking/baker.h"
#include "cli/terminal/say.h"
#include "sim/step_table.h"

namespace throng::cli {
namespace {

/// People who enter little by little, a wall that they go round, a line that they wait in.
constexpr const char* kSmallCrowd = R"({
  "throng": 1, "simulation": {"duration": 10, "method": "binned"},
  "roads": [{"id": "street", "centreline": [[-20, 0], [20, 0]], "width": 10}],
  "areas": [{"id": "stand", "polygon": [[-4, 1], [4, 1], [4, 5], [-4, 5]]}],
  "walls": [{"points": [[-3, -1], [3, -1]], "thickness": 0.3}],
  "flows": [
    {"id": "through", "from": "street:start", "to": "street:end", "count": 40, "end": 8},
    {"id": "for tea", "from": "street:end", "to": "street:start", "count": 20, "end": 8,
     "via": [{"at": "stand", "activity": "queue", "line": [[3, 3], [-3, 3]], "wait": 4}]}]})";

constexpr const char* kHeader =
    R"(One step of {} ({} people), in the order in which the device is asked.
A buffer stands with the bytes of one element and what it has an element for: bodies 32/person.
Read and written: bytes per person and launch, the elements of the person's own row or slot, whole and once.
What a program looks at of others is not in them, nor are buffers with elements for anything but people and
sites (people and wall tiles).

)";

LoadedLayout smallCrowd() {
    return std::move(tryReadLayout(kSmallCrowd, "a small crowd", {}).loaded);
}

std::string describe(const gl::Contents& contents) {
    return fmt::format("{} {}{}{}", contents.name, contents.element_bytes, contents.per.empty() ? "" : "/",
                       contents.per);
}

/// In lines that end before column 120.
std::string listed(const sim::StepRow& row, bool gl::Touch::*how) {
    constexpr std::size_t kIndent = 20, kEnd = 120;
    std::string text;
    std::size_t column = kIndent;
    for (const gl::Touch& touch : row.touches) {
        if (!(touch.*how)) continue;
        const std::string word = describe(*touch.contents);
        if (!text.empty()) text += ",";
        if (column + word.size() + 3 > kEnd) {
            text += fmt::format("\n{:{}}", "", kIndent - 1);
            column = kIndent;
        }
        text += text.empty() ? word : " " + word;
        column += word.size() + 2;
    }
    return text.empty() ? "-" : text;
}

void printTable(const std::vector<sim::StepPass>& passes) {
    fmt::print("{:<10}  {:<64} {:>8} {:>8} {:>8}\n", "pass", "program or transfer", "launches", "read",
               "written");
    double launches = 0.0, read = 0.0, written = 0.0;
    for (const sim::StepPass& pass : passes) {
        if (pass.rows.empty()) fmt::print("{:<10}  nothing to do\n", pass.name);
        for (const sim::StepRow& row : pass.rows) {
            const std::size_t row_read = row.bytesReadPerPerson(), row_written = row.bytesWrittenPerPerson();
            fmt::print("{:<10}  {:<64} {:>8.4g} {:>8} {:>8}\n", pass.name, row.what, row.launches, row_read,
                       row_written);
            fmt::print("            reads   {}\n", listed(row, &gl::Touch::reads));
            fmt::print("            writes  {}\n", listed(row, &gl::Touch::writes));
            launches += row.launches;
            read += row.launches * static_cast<double>(row_read);
            written += row.launches * static_cast<double>(row_written);
        }
    }
    fmt::print("{:<10}  {:<64} {:>8.4g} {:>8.0f} {:>8.0f}\n", "a step", "", launches, read, written);
}

nlohmann::ordered_json toJson(const sim::StepRow& row, bool gl::Touch::*how) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const gl::Touch& touch : row.touches)
        if (touch.*how)
            list.push_back({{"buffer", touch.contents->name},
                            {"element_bytes", touch.contents->element_bytes},
                            {"per", touch.contents->per}});
    return list;
}

nlohmann::ordered_json toJson(const std::vector<sim::StepPass>& passes) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const sim::StepPass& pass : passes) {
        nlohmann::ordered_json rows = nlohmann::ordered_json::array();
        for (const sim::StepRow& row : pass.rows)
            rows.push_back({{"what", row.what},
                            {"declared", row.declared},
                            {"launches", row.launches},
                            {"bytes_read_per_person", row.bytesReadPerPerson()},
                            {"bytes_written_per_person", row.bytesWrittenPerPerson()},
                            {"reads", toJson(row, &gl::Touch::reads)},
                            {"writes", toJson(row, &gl::Touch::writes)}});
        list.push_back({{"pass", pass.name}, {"rows", rows}});
    }
    return list;
}

}  // namespace

void printPasses(const std::string& layout, bool as_json) {
    const LoadedLayout loaded = layout.empty() ? smallCrowd() : loadLayout(layout, {});
    const std::size_t people = loaded.scene.people.size();
    const Baker baker(-1, "", people);
    sim::Simulation simulation = baker.simulate(loaded.scene);
    const std::vector<sim::StepPass> passes = sim::tabulateStep(simulation);
    baker.context().check("tabulating the passes");
    const std::string& name = loaded.diagnostics.file;
    if (as_json) {
        const nlohmann::ordered_json document = {{"layout", name},
                                                 {"people", people},
                                                 {"device", baker.device().name},
                                                 {"passes", toJson(passes)}};
        sayJson(document);
        return;
    }
    fmt::print(kHeader, name, people);
    printTable(passes);
}

}  // namespace throng::cli
