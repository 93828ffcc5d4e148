// SPDX-License-Identifier: Apache-2.0
#include "io/streams/stream_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace throng::io {
namespace {

/// The text after `'key':` in the Python dictionary of an NPY header, without leading blanks.
std::optional<std::string_view> valueOf(std::string_view dictionary, std::string_view key) {
    const std::string quoted = fmt::format("'{}':", key);
    const std::size_t at = dictionary.find(quoted);
    if (at == std::string_view::npos) return std::nullopt;
    std::string_view value = dictionary.substr(at + quoted.size());
    value.remove_prefix(std::min(value.find_first_not_of(' '), value.size()));
    return value;
}

/// The numbers of a Python tuple such as "(480, 1024, 3)"; nothing unless all of it is understood.
std::optional<std::vector<std::uint64_t>> parseTuple(std::string_view text) {
    if (text.empty() || text.front() != '(') return std::nullopt;
    const char* at = text.data() + 1;
    const char* const end = text.data() + text.size();
    std::vector<std::uint64_t> numbers;
    while (true) {
        while (at != end && *at == ' ')
            ++at;
        if (at != end && *at == ')') return numbers;
        std::uint64_t number = 0;
        const auto [next, error] = std::from_chars(at, end, number);
        if (error != std::errc{}) return std::nullopt;
        numbers.push_back(number);
        at = next;
        if (at != end && *at == ',') ++at;
    }
}

template <typename T>
T valueAt(std::span<const std::byte> bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof(T));
    return value;
}

}  // namespace

StreamReader::StreamReader(const std::filesystem::path& path) : file_(path) {
    std::array<char, 12> magic{};
    if (file_.size() < magic.size()) throw InputError(path, "too short to be a stream");
    file_.readAt(0, std::as_writable_bytes(std::span(magic)));
    if (std::memcmp(magic.data(), "POINTCACHE2", magic.size()) == 0)
        readPc2Header();
    else if (std::memcmp(magic.data(), "\x93NUMPY", 6) == 0)
        readNpyHeader();
    else if (std::memcmp(magic.data(), kPackedMagic.data(), kPackedMagic.size()) == 0)
        openPacked();
    else
        throw InputError(path, "neither an NPY nor a PC2 nor a packed stream");
}

void StreamReader::openPacked() {
    format_ = StreamFormat::packed;
    packed_ = std::make_unique<PackedReader>(file_);
    frames_ = packed_->frames();
    rows_ = packed_->rows();
}

void StreamReader::readPc2Header() {
    format_ = StreamFormat::pc2;
    data_offset_ = headerSize(format_);
    std::array<std::byte, headerSize(StreamFormat::pc2)> header{};
    file_.readAt(0, header);
    if (valueAt<std::int32_t>(header, 12) != 1) throw InputError(file_.path(), "PC2 version is not 1");
    const auto rows = valueAt<std::int32_t>(header, 16);
    const auto frames = valueAt<std::int32_t>(header, 28);
    if (rows < 0 || frames < 0) throw InputError(file_.path(), "negative counts in the PC2 header");
    setCounts(static_cast<std::uint64_t>(frames), static_cast<std::uint64_t>(rows));
}

void StreamReader::readNpyHeader() {
    format_ = StreamFormat::npy;
    std::array<std::byte, 12> preamble{};
    file_.readAt(0, preamble);
    const int version = static_cast<int>(preamble[6]);
    if (version != 1 && version != 2) throw InputError(file_.path(), "NPY version is neither 1 nor 2");
    const std::uint64_t start = version == 1 ? 10 : 12;
    const std::uint64_t length =
        version == 1 ? valueAt<std::uint16_t>(preamble, 8) : valueAt<std::uint32_t>(preamble, 8);
    if (length > 65536) throw InputError(file_.path(), "the NPY header is too long");
    std::string dictionary(static_cast<std::size_t>(length), '\0');
    file_.readAt(start, std::as_writable_bytes(std::span(dictionary)));
    data_offset_ = start + length;

    const auto type = valueOf(dictionary, "descr");
    if (!type || !type->starts_with("'<f4'")) throw InputError(file_.path(), "the NPY type is not '<f4'");
    const auto order = valueOf(dictionary, "fortran_order");
    if (!order || !order->starts_with("False"))
        throw InputError(file_.path(), "the NPY array is not in C order");
    const auto shape = valueOf(dictionary, "shape");
    const auto counts = shape ? parseTuple(*shape) : std::nullopt;
    if (!counts || counts->size() != 3 || (*counts)[2] != kComponents)
        throw InputError(file_.path(), "the NPY shape is not (frames, people, 3)");
    setCounts((*counts)[0], (*counts)[1]);
}

void StreamReader::setCounts(std::uint64_t frames, std::uint64_t rows) {
    if (frames > 0xffffffffu || rows > 0xffffffffu)
        throw InputError(file_.path(), "the header's counts are too large");
    // Both counts fit 32 bits, so their product fits 64; times 12 it may not, and a division says so.
    const std::uint64_t data = file_.size() - data_offset_;
    constexpr std::uint64_t kRowBytes = kComponents * sizeof(float);
    if (data % kRowBytes != 0 || data / kRowBytes != frames * rows) {
        throw InputError(file_.path(),
                         fmt::format("holds {} bytes of data where {} frames of {} people take {} values "
                                     "of 4 bytes: {}",
                                     data, frames, rows, kComponents,
                                     data / kRowBytes < frames * rows ? "truncated" : "too long"));
    }
    frames_ = static_cast<std::uint32_t>(frames);
    rows_ = static_cast<std::uint32_t>(rows);
}

void StreamReader::readRows(std::uint32_t frame, std::uint32_t first_row, std::span<float> values) const {
    const std::uint64_t count = values.size() / kComponents;
    if (frame >= frames_ || values.size() % kComponents != 0 || first_row + count > rows_)
        throw std::out_of_range("no such frame or rows in the stream");
    const std::uint64_t row = std::uint64_t{frame} * rows_ + first_row;
    if (packed_)
        packed_->readRows(file_, frame, first_row, values);
    else
        file_.readAt(data_offset_ + row * kComponents * sizeof(float), std::as_writable_bytes(values));
    constexpr float kMost = 4.0e9f;  // of metres as of anything else; and what is no number is not within it
    if (!std::ranges::all_of(values, [](float value) { return std::abs(value) <= kMost; }))
        throw InputError(file_.path(),
                         fmt::format("frame {} holds something that is not a number of any use", frame));
}

}  // namespace throng::io
