// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace throng::io {

/// Of a .npy file, version 1.0, of floats in frames of things of columns.
std::string npyHeader(const std::array<std::size_t, 3>& shape);

}  // namespace throng::io
