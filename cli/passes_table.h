// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace throng::cli {

/// Prints what the passes of a step read and write.
/// @param layout a file, or empty for a small crowd that has something to do for every pass
/// @throws Exit as loadLayout
void printPasses(const std::string& layout, bool as_json);

}  // namespace throng::cli
