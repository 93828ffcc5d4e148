// SPDX-License-Identifier: Apache-2.0
#include "io/streams/npy_header.h"

#include <fmt/format.h>

namespace throng::io {
namespace {

constexpr std::size_t kAlignment = 64;

}  // namespace

std::string npyHeader(const std::array<std::size_t, 3>& shape) {
    std::string text = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}, {}), }}",
                                   shape[0], shape[1], shape[2]);
    constexpr std::size_t kBefore = 10;
    text.resize((kBefore + text.size() + kAlignment) / kAlignment * kAlignment - kBefore - 1, ' ');
    text += '\n';
    std::string header("\x93NUMPY\x01\x00", 8);
    header += static_cast<char>(text.size() & 0xffu);
    header += static_cast<char>(text.size() >> 8);
    return header + text;
}

}  // namespace throng::io
