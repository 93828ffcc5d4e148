// SPDX-License-Identifier: Apache-2.0
#include "parts.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <random>

#include "harness.h"

namespace throng::fuzz {

Parts unpacked(std::string_view input) {
    Parts parts;
    const auto take = [&](std::size_t count) {
        const std::string_view taken = input.substr(0, count);
        input.remove_prefix(taken.size());
        return taken;
    };
    while (!input.empty()) {
        const std::string_view name = take(static_cast<unsigned char>(take(1).front()));
        std::uint32_t size = 0;
        for (int shift = 0; const char byte : take(4)) {
            size |= static_cast<std::uint32_t>(static_cast<unsigned char>(byte)) << shift;
            shift += 8;
        }
        parts.emplace_back(name, take(size));
    }
    return parts;
}

std::string packed(const Parts& parts) {
    std::string bytes;
    for (const auto& [name, content] : parts) {
        bytes += static_cast<char>(std::min<std::size_t>(name.size(), 255));
        bytes += name.substr(0, 255);
        for (int shift = 0; shift < 32; shift += 8)
            bytes += static_cast<char>(content.size() >> shift);
        bytes += content;
    }
    return bytes;
}

std::string mutatedPart(std::string_view input, const JsonMutator& json, std::size_t most, unsigned seed) {
    std::mt19937 random(seed);
    Parts parts = unpacked(input);
    if (parts.empty() || random() % 30 == 0) return mutatedBytes(input, most);
    auto& [name, content] = parts[random() % parts.size()];
    const std::size_t others = packed(parts).size() - content.size();
    if (others >= most) return mutatedBytes(input, most);
    const auto own_seed = static_cast<unsigned>(random());
    content = name.ends_with(".json") ? json.mutate(content, most - others, own_seed)
                                      : mutatedBytes(content, most - others);
    return packed(parts);
}

void putParts(const Parts& parts, const std::string& into, std::span<const char* const> names) {
    for (const char* const name : names) {
        const std::string file = into + "/" + name;
        const auto part = std::ranges::find(parts, std::string_view(name),
                                            [](const auto& each) { return std::string_view(each.first); });
        if (part != parts.end())
            put(file, part->second);
        else
            std::filesystem::remove(folder() / file);
    }
}

}  // namespace throng::fuzz
