// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/formation_complaints.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

namespace throng::authoring {

void FormationComplaints::add(std::uint64_t i, const std::string& what, const std::string& hint,
                              const std::string& detail, Severity severity, const Waypoint* waypoint) {
    const auto known = std::find_if(complaints_.begin(), complaints_.end(),
                                    [&](const Complaint& complaint) { return complaint.what == what; });
    if (known == complaints_.end())
        complaints_.push_back({what, hint, detail, severity, i, 1, waypoint});
    else
        ++known->count;
}

void FormationComplaints::tell(const Formation& formation, Diagnostics& diagnostics) {
    const auto* list = std::get_if<ListFormation>(&formation.shape);
    for (const Complaint& complaint : complaints_) {
        const SourcePosition& where = complaint.waypoint ? complaint.waypoint->where
                                      : list             ? list->agents[complaint.first].where
                                                         : formation.where;
        std::string text = fmt::format("formation `{}`: person {} {}{}", formation.id, complaint.first,
                                       complaint.what, complaint.detail);
        if (complaint.count > 1)
            text += fmt::format(", and {} more of the formation likewise", complaint.count - 1);
        if (complaint.severity == Severity::error)
            diagnostics.error(where, text, complaint.hint);
        else
            diagnostics.warning(where, text, complaint.hint);
    }
    complaints_.clear();
}

}  // namespace throng::authoring
