// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace throng::gl {

/// What a shader's text lets a program do with something that it declares and others own.
struct Access {
    std::string name;  ///< of a storage block, a uniform block, a sampler or an image
    bool reads = true;
    bool writes = false;
};

/// All that a complete shader declares, whether it uses it or not, by the qualifiers `readonly` and
/// `writeonly` before each: drivers do not tell them. A storage block without them is read and written. What
/// is declared twice, in branches of an #if, may do what either may.
std::vector<Access> accessIn(std::string_view source);

/// The same of several shaders together.
void addAccess(std::vector<Access>& known, const Access& more);

}  // namespace throng::gl
