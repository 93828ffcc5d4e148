// SPDX-License-Identifier: Apache-2.0
#include "base/json_shape.h"

#include <array>

namespace throng {

const char* tooMuchIn(std::string_view json) {
    std::array<std::size_t, kMostDepth + 1> keys{};  // of what is open, by depth
    std::size_t depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\') ++i;
            in_string = c != '"';
        } else if (c == '"') {
            in_string = true;
        } else if (c == '[' || c == '{') {
            if (++depth > kMostDepth) return "is nested more than 64 deep";
            keys[depth] = 0;
        } else if ((c == ']' || c == '}') && depth > 0) {
            --depth;
        } else if (c == ':' && ++keys[depth] > kMostKeys) {
            return "has an object with more than 2000 keys";
        }
    }
    return nullptr;
}

}  // namespace throng
