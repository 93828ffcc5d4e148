// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sim/gl/journal.h"

namespace throng::gl {

inline constexpr std::size_t kWord = sizeof(std::uint32_t);  ///< bytes

/// Room for so many elements, of so many bytes each.
struct Room {
    std::size_t count = 0;
    std::size_t element_bytes = 0;
    std::string per;  ///< what there is one element for, e.g. "person"
};

/// A buffer in the device's memory. Moves, never copies.
class Buffer {
  public:
    enum class Use {
        device,     ///< written by shaders; the CPU reaches it through upload() and download() only
        in_ranges,  ///< as device, but shaders write it range by range: may be larger than a storage block
        read_back,  ///< persistently mapped for reading: see mapped()
    };

    Buffer() = default;
    /// @param bytes at least 4 are allocated, so that an empty scene still has something to bind
    /// @throws GraphicsError when the device has no memory left; `name` goes in the message and into
    /// debuggers
    Buffer(const std::string& name, const Room& room, Use use = Use::device);
    /// The same for one thing of so many bytes.
    Buffer(const std::string& name, std::size_t bytes, Use use = Use::device);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    std::uint32_t handle() const { return handle_; }
    std::size_t bytes() const { return bytes_; }
    const std::shared_ptr<const Contents>& contents() const { return contents_; }

    /// Mapped memory of a read_back buffer. Valid contents need a fence after the commands that wrote it.
    const std::byte* mapped() const { return mapped_; }

    void fill(std::uint32_t word);
    void copyFrom(const Buffer& source);
    /// The first bytes of another, to somewhere in this one.
    void copyFrom(const Buffer& source, std::size_t to, std::size_t bytes);

    template <class T>
    void upload(std::span<const T> items, std::size_t first_item = 0) {
        uploadBytes(std::as_bytes(items), first_item * sizeof(T));
    }
    template <class T>
    void upload(const std::vector<T>& items) {
        upload(std::span<const T>(items));
    }
    /// Waits for the device: for tests and for the end of a bake, never inside a step.
    template <class T>
    std::vector<T> download(std::size_t count, std::size_t first_item = 0) const {
        std::vector<T> items(count);
        downloadBytes(std::as_writable_bytes(std::span<T>(items)), first_item * sizeof(T));
        return items;
    }
    /// Likewise, what lies so many bytes into each element, of elements that have more to them than that.
    template <class T>
    std::vector<T> downloadParts(std::size_t count, std::size_t first_element = 0, std::size_t at = 0) const {
        const std::size_t stride = contents_->element_bytes;
        const std::vector<std::byte> bytes = download<std::byte>(count * stride, first_element * stride);
        std::vector<T> parts(count);
        for (std::size_t i = 0; i < count; ++i)
            std::memcpy(&parts[i], bytes.data() + i * stride + at, sizeof(T));
        return parts;
    }

  private:
    void uploadBytes(std::span<const std::byte> bytes, std::size_t offset);
    void downloadBytes(std::span<std::byte> bytes, std::size_t offset) const;
    void release();

    std::uint32_t handle_ = 0;
    std::size_t bytes_ = 0;
    std::shared_ptr<const Contents> contents_;
    const std::byte* mapped_ = nullptr;
};

/// Bytes of all buffers that there are, of whatever context.
std::size_t bytesOfBuffers();

/// While one lives, this thread's buffers are counted and not made: what something will need is known before
/// a device is asked for it. They can be bound to nothing. At most one lives at a time.
class BufferCount {
  public:
    BufferCount();
    ~BufferCount();
    BufferCount(const BufferCount&) = delete;
    BufferCount& operator=(const BufferCount&) = delete;

    struct Counted {
        std::string name, per;
        std::size_t bytes = 0;
    };
    const std::vector<Counted>& buffers() const { return buffers_; }
    std::size_t bytes() const;

    /// The one that counts, or null.
    static BufferCount* kept();
    void add(const Contents& contents, std::size_t bytes) {
        buffers_.push_back({contents.name, contents.per, bytes});
    }

  private:
    std::vector<Counted> buffers_;
};

/// A view of a buffer as unsigned words that shaders fetch through a sampler: for random reads, which some
/// devices serve faster that way. The buffer must stay in place.
class WordTexture {
  public:
    enum class Texel { one_word, two_words, four_words };

    WordTexture() = default;
    /// @throws GraphicsError when the buffer has more texels than the device can address
    explicit WordTexture(const Buffer& buffer, Texel texel = Texel::one_word);
    ~WordTexture();
    WordTexture(WordTexture&& other) noexcept;
    WordTexture& operator=(WordTexture&& other) noexcept;
    std::uint32_t handle() const { return handle_; }
    /// The buffer's.
    const std::shared_ptr<const Contents>& contents() const { return contents_; }

  private:
    std::uint32_t handle_ = 0;
    std::shared_ptr<const Contents> contents_;
};

/// A buffer that holds so many items from the start, which are made only where somebody will read them.
/// @param per what there is one of them for
/// @param make () -> std::vector<T> of `count`
template <class T, class Make>
Buffer makeBuffer(const std::string& name, std::size_t count, const std::string& per, Make make,
                  Buffer::Use use = Buffer::Use::device) {
    Buffer buffer(name, Room{count, sizeof(T), per}, use);
    if (BufferCount::kept()) return buffer;
    if (count == 0)
        buffer.fill(0);  // there is room for one word all the same
    else
        buffer.upload(make());
    return buffer;
}

/// A buffer that holds `items` from the start.
template <class T>
Buffer makeBuffer(const std::string& name, const std::vector<T>& items, const std::string& per = "",
                  Buffer::Use use = Buffer::Use::device) {
    return makeBuffer<T>(
        name, items.size(), per, [&]() -> const std::vector<T>& { return items; }, use);
}

}  // namespace throng::gl
