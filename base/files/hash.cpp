// SPDX-License-Identifier: Apache-2.0
#include "base/files/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <new>
#include <vector>

namespace throng {

std::string hashText(std::string_view text) {
    return fmt::format("{:016x}", XXH3_64bits(text.data(), text.size()));
}

struct Hasher::State {
    XXH3_state_t* xxh3 = XXH3_createState();
    ~State() { XXH3_freeState(xxh3); }
};

Hasher::Hasher() : state_(std::make_unique<State>()) {
    if (!state_->xxh3 || XXH3_64bits_reset(state_->xxh3) == XXH_ERROR) throw std::bad_alloc();
}
Hasher::~Hasher() = default;
Hasher::Hasher(Hasher&&) noexcept = default;
Hasher& Hasher::operator=(Hasher&&) noexcept = default;

void Hasher::add(std::span<const std::byte> bytes) {
    XXH3_64bits_update(state_->xxh3, bytes.data(), bytes.size());
}

std::uint64_t Hasher::digest() const {
    return XXH3_64bits_digest(state_->xxh3);
}

FileHash hashFile(const std::filesystem::path& path) {
    return hashFile(InputFile(path));
}

FileHash hashFile(const InputFile& file, const std::function<void(std::uint64_t)>& advance) {
    Hasher hasher;
    std::vector<std::byte> piece(std::size_t{1} << 20);
    for (std::uint64_t offset = 0; offset < file.size();) {
        const std::size_t count =
            static_cast<std::size_t>(std::min<std::uint64_t>(piece.size(), file.size() - offset));
        file.readAt(offset, std::span(piece).first(count));
        hasher.add(std::span(piece).first(count));
        offset += count;
        if (advance) advance(count);
    }
    return {file.size(), fmt::format("{:016x}", hasher.digest())};
}

}  // namespace throng
