// SPDX-License-Identifier: Apache-2.0
#include "authoring/cli/commands.h"

namespace throng::cli {

void addPreview(CLI::App&) {}

}  // namespace throng::cli
