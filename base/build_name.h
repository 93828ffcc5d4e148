// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace throng {

/// Which state of the sources the program was built from, as `git describe` names it, with "-dirty" where
/// files were changed beside it; "unknown" where they were no checkout.
std::string_view buildName();

}  // namespace throng
