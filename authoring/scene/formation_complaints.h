// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"

namespace throng::authoring {

/// What is wrong with people of a formation, once for all of them.
class FormationComplaints {
  public:
    /// @param i which of the people; @param waypoint that it is about; null: none
    void add(std::uint64_t i, const std::string& what, const std::string& hint,
             const std::string& detail = "", Severity severity = Severity::error,
             const Waypoint* waypoint = nullptr);
    /// Tells them, and forgets them.
    void tell(const Formation& formation, Diagnostics& diagnostics);

  private:
    struct Complaint {
        std::string what, hint, detail;
        Severity severity = Severity::error;
        std::uint64_t first = 0, count = 0;
        const Waypoint* waypoint = nullptr;  // that it is about
    };
    std::vector<Complaint> complaints_;
};

}  // namespace throng::authoring
