// SPDX-License-Identifier: Apache-2.0
#include "io/streams/packed_block.h"

#include <zstd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <new>
#include <stdexcept>

namespace throng::io {
namespace {

constexpr int kLevel = 3;
constexpr std::size_t kOrders = 3;  // nothing is expected; the same as before; the same change as before
constexpr std::size_t kMostPlanes = sizeof(std::uint32_t);
constexpr std::size_t kHead = 2 * kComponents;  // order and planes of each component

constexpr std::uint32_t zigzag(std::uint32_t value) {
    return (value << 1) ^ (value >> 31 ? 0xffffffffu : 0u);
}
constexpr std::uint32_t unzigzag(std::uint32_t value) {
    return (value >> 1) ^ (value & 1u ? 0xffffffffu : 0u);
}

/// What one number is off from what those before it let expect, whichever of the orders is taken: all modulo
/// 2^32, so that nothing overflows.
class Expectation {
  public:
    std::array<std::uint32_t, kOrders> off(std::uint32_t value) {
        const std::array<std::uint32_t, kOrders> by_order{value, value - last_, value - last_ - change_};
        goOn(value);
        return by_order;
    }
    std::uint32_t next(std::uint32_t off, std::size_t order) {
        const std::uint32_t value = off + (order > 0 ? last_ : 0) + (order > 1 ? change_ : 0);
        goOn(value);
        return value;
    }

  private:
    /// The first number is no change from anything.
    void goOn(std::uint32_t value) {
        change_ = has_begun_ ? value - last_ : 0;
        last_ = value;
        has_begun_ = true;
    }

    std::uint32_t last_ = 0, change_ = 0;
    bool has_begun_ = false;
};

/// Calls take(off, cell) for the numbers of a component, one row after the other.
template <class Take>
void eachOff(const Steps* steps, std::size_t stride, BlockSize size, std::size_t component, Take take) {
    std::size_t cell = 0;
    for (std::uint32_t row = 0; row < size.rows; ++row) {
        Expectation expectation;
        for (std::uint32_t frame = 0; frame < size.frames; ++frame)
            take(expectation.off(static_cast<std::uint32_t>(steps[frame * stride + row][component])), cell++);
    }
}

struct Choice {
    std::size_t order = 0, planes = 0;
};

/// The order that leaves the fewest bits, and the bytes that its largest number takes.
Choice chooseOrder(const Steps* steps, std::size_t stride, BlockSize size, std::size_t component) {
    std::array<std::uint64_t, kOrders> bits{};
    std::array<std::uint32_t, kOrders> all{};
    eachOff(steps, stride, size, component, [&](const std::array<std::uint32_t, kOrders>& off, std::size_t) {
        for (std::size_t order = 0; order < kOrders; ++order) {
            const std::uint32_t number = zigzag(off[order]);
            bits[order] += static_cast<std::uint64_t>(std::bit_width(number));
            all[order] |= number;
        }
    });
    const auto order = static_cast<std::size_t>(std::ranges::min_element(bits) - bits.begin());
    return {order, (static_cast<std::size_t>(std::bit_width(all[order])) + 7) / 8};
}

}  // namespace

std::optional<std::int32_t> stepsOf(float value, double step) {
    const double steps = static_cast<double>(value) / step;
    if (!(std::abs(steps) < 2147483647.0)) return std::nullopt;
    // Doubles of this size have no fraction: adding rounds to the nearest, and far faster than asking for it.
    constexpr double kNoFraction = 6755399441055744.0;
    return static_cast<std::int32_t>((steps + kNoFraction) - kNoFraction);
}

struct BlockEncoder::Context {
    ZSTD_CCtx* zstd = ZSTD_createCCtx();
    Context() {
        if (!zstd) throw std::bad_alloc();
        ZSTD_CCtx_setParameter(zstd, ZSTD_c_compressionLevel, kLevel);
        ZSTD_CCtx_setParameter(zstd, ZSTD_c_checksumFlag, 1);
    }
    ~Context() { ZSTD_freeCCtx(zstd); }
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
};

BlockEncoder::BlockEncoder() : context_(std::make_unique<Context>()) {}
BlockEncoder::~BlockEncoder() = default;
BlockEncoder::BlockEncoder(BlockEncoder&&) noexcept = default;

std::span<const std::byte> BlockEncoder::encode(const Steps* steps, std::size_t stride, BlockSize size) {
    const std::size_t cells = size.cells();
    content_.assign(kHead, std::byte{0});
    for (std::size_t component = 0; component < kComponents; ++component) {
        const Choice choice = chooseOrder(steps, stride, size, component);
        content_[2 * component] = static_cast<std::byte>(choice.order);
        content_[2 * component + 1] = static_cast<std::byte>(choice.planes);
        const std::size_t begin = content_.size();
        content_.resize(begin + choice.planes * cells);
        eachOff(steps, stride, size, component,
                [&](const std::array<std::uint32_t, kOrders>& off, std::size_t cell) {
                    const std::uint32_t number = zigzag(off[choice.order]);
                    for (std::size_t plane = 0; plane < choice.planes; ++plane)
                        content_[begin + plane * cells + cell] =
                            static_cast<std::byte>(number >> (8 * plane) & 0xffu);
                });
    }
    packed_.resize(ZSTD_compressBound(content_.size()));
    const std::size_t bytes =
        ZSTD_compress2(context_->zstd, packed_.data(), packed_.size(), content_.data(), content_.size());
    if (ZSTD_isError(bytes)) throw std::runtime_error(ZSTD_getErrorName(bytes));
    return std::span<const std::byte>(packed_).first(bytes);
}

struct BlockDecoder::Context {
    ZSTD_DCtx* zstd = ZSTD_createDCtx();
    Context() {
        if (!zstd) throw std::bad_alloc();
    }
    ~Context() { ZSTD_freeDCtx(zstd); }
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
};

BlockDecoder::BlockDecoder() : context_(std::make_unique<Context>()) {}
BlockDecoder::~BlockDecoder() = default;
BlockDecoder::BlockDecoder(BlockDecoder&&) noexcept = default;
BlockDecoder& BlockDecoder::operator=(BlockDecoder&&) noexcept = default;

bool BlockDecoder::decode(std::span<const std::byte> bytes, BlockSize size, std::span<Steps> steps) {
    const std::size_t cells = size.cells();
    content_.resize(kHead + kComponents * kMostPlanes * cells);
    const std::size_t length =
        ZSTD_decompressDCtx(context_->zstd, content_.data(), content_.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(length) || length < kHead || steps.size() != cells) return false;
    std::size_t begin = kHead;
    for (std::size_t component = 0; component < kComponents; ++component) {
        const auto order = static_cast<std::size_t>(content_[2 * component]);
        const auto planes = static_cast<std::size_t>(content_[2 * component + 1]);
        if (order >= kOrders || planes > kMostPlanes || length - begin < planes * cells) return false;
        for (std::uint32_t row = 0; row < size.rows; ++row) {
            Expectation expectation;
            for (std::uint32_t frame = 0; frame < size.frames; ++frame) {
                const std::size_t cell = begin + std::size_t{row} * size.frames + frame;
                std::uint32_t number = 0;
                for (std::size_t plane = 0; plane < planes; ++plane)
                    number |= static_cast<std::uint32_t>(content_[cell + plane * cells]) << (8 * plane);
                steps[std::size_t{frame} * size.rows + row][component] =
                    static_cast<std::int32_t>(expectation.next(unzigzag(number), order));
            }
        }
        begin += planes * cells;
    }
    return begin == length;
}

}  // namespace throng::io
