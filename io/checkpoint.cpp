// SPDX-License-Identifier: Apache-2.0
#include "io/checkpoint.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "base/files/hash.h"
#include "base/files/input_file.h"
#include "base/files/output_file.h"

// The file: the magic word, how many bytes there are in all and their XXH3, then the content: counts and
// texts and sections one after the other, numbers as they lie in memory.
namespace throng::io {
namespace fs = std::filesystem;
namespace {

constexpr char kMagic[8] = {'T', 'H', 'R', 'O', 'N', 'G', 'C', '1'};
constexpr const char* kNames[] = {"checkpoint.a", "checkpoint.b"};

struct Head {
    char magic[8];
    std::uint64_t bytes;  // of the content
    std::uint64_t xxh3;   // of the content
};

std::span<const std::byte> bytesOf(const std::string& text) {
    return std::as_bytes(std::span(text));
}

/// Hands the content to `take`, piece by piece: sections may be large.
template <class Take>
void serialise(const Checkpoint& checkpoint, Take take) {
    const auto number = [&](std::uint64_t value) { take(std::as_bytes(std::span(&value, 1))); };
    const auto piece = [&](std::span<const std::byte> bytes) {
        number(bytes.size());
        take(bytes);
    };
    piece(bytesOf(checkpoint.identity));
    number(checkpoint.frames);
    number(checkpoint.steps);
    number(checkpoint.sections.size());
    for (const auto& [name, bytes] : checkpoint.sections) {
        piece(bytesOf(name));
        piece(bytes);
    }
}

/// Reads what serialise() made; everything has been checked by its hash before.
class Content {
  public:
    explicit Content(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

    std::uint64_t number() {
        std::uint64_t value = 0;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }
    std::span<const std::byte> piece() { return take(number()); }
    std::string text() {
        const std::span<const std::byte> bytes = piece();
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }

  private:
    std::span<const std::byte> take(std::uint64_t count) {
        if (count > bytes_.size() - at_) throw std::out_of_range("a checkpoint ends early");
        at_ += count;
        return std::span(bytes_).subspan(at_ - count, count);
    }

    std::vector<std::byte> bytes_;
    std::size_t at_ = 0;
};

template <class T>
T readOne(const InputFile& file, std::uint64_t offset) {
    T value{};
    file.readAt(offset, std::as_writable_bytes(std::span(&value, 1)));
    return value;
}

/// Nothing where it is none of a file of this length.
std::optional<Head> headOf(const InputFile& file) {
    if (file.size() < sizeof(Head)) return std::nullopt;
    const auto head = readOne<Head>(file, 0);
    if (std::memcmp(head.magic, kMagic, sizeof kMagic) != 0 || head.bytes != file.size() - sizeof head)
        return std::nullopt;
    return head;
}

/// How many frames a checkpoint goes on from, without reading gigabytes of it into memory; nothing where it
/// is torn.
std::optional<std::uint64_t> framesOf(const fs::path& path) try {
    constexpr std::uint64_t kPiece = 1 << 20;
    const InputFile file(path);
    const std::optional<Head> head = headOf(file);
    if (!head) return std::nullopt;
    std::vector<std::byte> piece(kPiece);
    Hasher hasher;
    for (std::uint64_t at = 0; at < head->bytes; at += kPiece) {
        const std::span<std::byte> next = std::span(piece).first(std::min(kPiece, head->bytes - at));
        file.readAt(sizeof *head + at, next);
        hasher.add(next);
    }
    if (hasher.digest() != head->xxh3) return std::nullopt;
    const auto identity_bytes = readOne<std::uint64_t>(file, sizeof *head);
    return readOne<std::uint64_t>(file, sizeof *head + sizeof identity_bytes + identity_bytes);
} catch (const std::exception&) {
    return std::nullopt;
}

std::optional<Checkpoint> loadOne(const fs::path& path) try {
    const InputFile file(path);
    const std::optional<Head> head = headOf(file);
    if (!head) return std::nullopt;
    std::vector<std::byte> bytes(head->bytes);
    file.readAt(sizeof *head, bytes);
    Hasher hasher;
    hasher.add(bytes);
    if (hasher.digest() != head->xxh3) return std::nullopt;
    Content content(std::move(bytes));
    Checkpoint checkpoint;
    checkpoint.identity = content.text();
    checkpoint.frames = static_cast<std::uint32_t>(content.number());
    checkpoint.steps = static_cast<std::uint32_t>(content.number());
    for (std::uint64_t left = content.number(); left > 0; --left) {
        const std::string name = content.text();
        checkpoint.add(name, content.piece());
    }
    return checkpoint;
} catch (const std::exception&) {
    return std::nullopt;  // not there, or not readable: as good as torn
}

}  // namespace

const std::vector<std::byte>* Checkpoint::find(const std::string& name) const {
    for (const auto& [known, bytes] : sections)
        if (known == name) return &bytes;
    return nullptr;
}

void saveCheckpoint(const fs::path& folder, const Checkpoint& checkpoint) {
    const std::optional<std::uint64_t> a = framesOf(folder / kNames[0]), b = framesOf(folder / kNames[1]);
    const bool replace_a = !a || (b && *b > *a);
    const fs::path path = folder / kNames[replace_a ? 0 : 1];

    Head head{{}, 0, 0};
    std::memcpy(head.magic, kMagic, sizeof kMagic);
    Hasher hasher;
    serialise(checkpoint, [&](std::span<const std::byte> bytes) {
        hasher.add(bytes);
        head.bytes += bytes.size();
    });
    head.xxh3 = hasher.digest();

    const fs::path fresh = path.string() + ".new";
    std::error_code ignored;
    fs::remove(fresh, ignored);  // of a process that was killed
    OutputFile file(fresh);
    file.write(std::as_bytes(std::span(&head, 1)));
    serialise(checkpoint, [&](std::span<const std::byte> bytes) { file.write(bytes); });
    file.finish();
    if (std::rename(fresh.c_str(), path.c_str()) != 0) throw OutputError(path, "replace", errno);
    syncFolder(folder);
}

std::optional<Checkpoint> loadCheckpoint(const fs::path& folder) {
    std::optional<Checkpoint> a = loadOne(folder / kNames[0]);
    std::optional<Checkpoint> b = loadOne(folder / kNames[1]);
    return a && (!b || a->frames > b->frames) ? a : b;
}

bool hasOnlyTornCheckpoints(const fs::path& folder) {
    std::error_code unknown;
    const bool has_any =
        std::ranges::any_of(kNames, [&](const char* name) { return fs::exists(folder / name, unknown); });
    return has_any && !loadCheckpoint(folder);
}

bool isCheckpoint(const fs::path& path) {
    return path.filename().string().starts_with("checkpoint.");
}

}  // namespace throng::io
