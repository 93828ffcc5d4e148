// SPDX-License-Identifier: Apache-2.0
#include "sim/gl/declaration.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace throng::gl {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

const Access* find(const std::vector<Access>& accesses, const std::string& name) {
    const auto found = std::find_if(accesses.begin(), accesses.end(),
                                    [&](const Access& access) { return access.name == name; });
    return found == accesses.end() ? nullptr : &*found;
}

}  // namespace

bool Declaration::readsFrom(const std::string& name) const {
    return contains(reads, name);
}

bool Declaration::writesTo(const std::string& name) const {
    return contains(writes, name);
}

void Declaration::check(const std::vector<Access>& allowed, const std::vector<std::string>& active) const {
    const auto refuse = [&](const char* does, const std::string& name, const char* but) {
        throw std::logic_error(
            fmt::format("pass `{}`: {} {} `{}`, {}", pass, fmt::join(shaders, " + "), does, name, but));
    };
    for (const std::string& name : active)
        if (!readsFrom(name) && !writesTo(name)) refuse("touches", name, "which is not declared");
    for (const std::vector<std::string>* names : {&reads, &writes})
        for (const std::string& name : *names) {
            const Access* can = find(allowed, name);
            if (!can) return refuse("has no", name, "which is declared");
            if (can->reads && !readsFrom(name)) refuse("may read", name, "declared to be written only");
            if (can->writes && !writesTo(name)) refuse("may write", name, "declared to be read only");
            if (!can->reads && readsFrom(name)) refuse("cannot read", name, "declared to be read");
            if (!can->writes && writesTo(name)) refuse("cannot write", name, "declared to be written");
        }
}

}  // namespace throng::gl
