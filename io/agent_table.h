// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "base/frame.h"
#include "recording/bake_description.h"

namespace throng::io {

/// The totals of an account, counted from its rows: agents = walking + arrived + refused.
struct AccountTotals {
    std::uint32_t agents = 0;
    std::uint32_t spawned = 0;
    std::uint32_t walking = 0;
    std::uint32_t arrived = 0;
    std::uint32_t refused = 0;
    std::map<std::string, std::uint32_t> refused_reasons;
};

/// Rows that still wait (when a bake is cut short) count as refused, with that reason.
AccountTotals countOutcomes(const Account& account);

/// agents.csv: a heading, then one line a row (RFC 4180, lines end in \n). The account has as many rows as
/// the description (std::invalid_argument otherwise).
std::string agentTable(const recording::BakeDescription& description, const Account& account);

}  // namespace throng::io
