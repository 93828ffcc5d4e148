// SPDX-License-Identifier: Apache-2.0
#include "io/files/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <memory>
#include <vector>

#include "io/files/input_file.h"

namespace throng::io {

std::string hashText(std::string_view text) {
    return fmt::format("{:016x}", XXH3_64bits(text.data(), text.size()));
}

FileHash hashFile(const std::filesystem::path& path) {
    const InputFile file(path);
    const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(),
                                                                                XXH3_freeState);
    if (!state || XXH3_64bits_reset(state.get()) == XXH_ERROR) throw std::bad_alloc();
    std::vector<std::byte> piece(std::size_t{1} << 20);
    for (std::uint64_t offset = 0; offset < file.size();) {
        const std::size_t count =
            static_cast<std::size_t>(std::min<std::uint64_t>(piece.size(), file.size() - offset));
        file.readAt(offset, std::span(piece).first(count));
        XXH3_64bits_update(state.get(), piece.data(), count);
        offset += count;
    }
    return {file.size(), fmt::format("{:016x}", XXH3_64bits_digest(state.get()))};
}

}  // namespace throng::io
