// SPDX-License-Identifier: Apache-2.0
#include "sim/gl/buffer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <utility>

#include "sim/gl/context.h"

namespace throng::gl {
namespace {

std::atomic<std::size_t> all_bytes{0};
thread_local BufferCount* counting = nullptr;

/// A transfer: from what, if from a buffer, and to what.
void note(const char* what, const Buffer* read, const Buffer* written) {
    Journal* journal = Journal::kept();
    if (!journal) return;
    std::vector<Touch> touches;
    if (read) touches.push_back({read->contents(), true, false});
    if (written) touches.push_back({written->contents(), false, true});
    journal->note(what, std::move(touches));
}

}  // namespace

Buffer::Buffer(const std::string& name, std::size_t bytes, Use use) : Buffer(name, Room{1, bytes, ""}, use) {}

Buffer::Buffer(const std::string& name, const Room& room, Use use)
    : bytes_(std::max<std::size_t>(room.count * room.element_bytes, 4)),
      contents_(std::make_shared<const Contents>(Contents{name, room.per, room.element_bytes})) {
    if (BufferCount* count = BufferCount::kept()) {
        count->add(*contents_, bytes_);
        return;
    }
    GLint64 block_limit = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block_limit);
    if (use != Use::in_ranges && bytes_ > static_cast<std::size_t>(block_limit))
        throw GraphicsError(fmt::format(
            "`{}` needs {:.0f} MiB, more than the {:.0f} MiB that this device gives to one buffer", name,
            static_cast<double>(bytes_) / 1048576.0, static_cast<double>(block_limit) / 1048576.0));
    glCreateBuffers(1, &handle_);
    const GLbitfield mapping = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    const GLbitfield flags =
        use == Use::read_back ? (mapping | GL_CLIENT_STORAGE_BIT) : GL_DYNAMIC_STORAGE_BIT;
    while (glGetError() != GL_NO_ERROR) {
    }
    glNamedBufferStorage(handle_, static_cast<GLsizeiptr>(bytes_), nullptr, flags);
    if (use == Use::read_back)
        mapped_ = static_cast<const std::byte*>(
            glMapNamedBufferRange(handle_, 0, static_cast<GLsizeiptr>(bytes_), mapping));
    if (glGetError() != GL_NO_ERROR || (use == Use::read_back && !mapped_)) {
        glDeleteBuffers(1, &handle_);
        handle_ = 0;
        throw GraphicsError(
            fmt::format("the device has no room for `{}` ({} bytes)", name, room.count * room.element_bytes));
    }
    all_bytes += bytes_;
    glObjectLabel(GL_BUFFER, handle_, static_cast<GLsizei>(name.size()), name.c_str());
}

Buffer::~Buffer() {
    release();
}

Buffer::Buffer(Buffer&& other) noexcept
    : handle_(std::exchange(other.handle_, 0)),
      bytes_(std::exchange(other.bytes_, 0)),
      contents_(std::move(other.contents_)),
      mapped_(std::exchange(other.mapped_, nullptr)) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    if (this != &other) {
        release();
        handle_ = std::exchange(other.handle_, 0);
        bytes_ = std::exchange(other.bytes_, 0);
        contents_ = std::move(other.contents_);
        mapped_ = std::exchange(other.mapped_, nullptr);
    }
    return *this;
}

void Buffer::fill(std::uint32_t word) {
    if (BufferCount::kept()) return;
    note("fill", nullptr, this);
    glClearNamedBufferData(handle_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &word);
}

void Buffer::copyFrom(const Buffer& source) {
    copyFrom(source, 0, std::min(bytes_, source.bytes_));
}

void Buffer::copyFrom(const Buffer& source, std::size_t to, std::size_t bytes) {
    note("copy", &source, this);
    glCopyNamedBufferSubData(source.handle_, handle_, 0, static_cast<GLintptr>(to),
                             static_cast<GLsizeiptr>(bytes));
}

void Buffer::uploadBytes(std::span<const std::byte> bytes, std::size_t offset) {
    if (offset + bytes.size() > bytes_) throw std::out_of_range("upload past the end of a buffer");
    if (BufferCount::kept()) return;
    note("upload", nullptr, this);
    glNamedBufferSubData(handle_, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes.size()),
                         bytes.data());
}

void Buffer::downloadBytes(std::span<std::byte> bytes, std::size_t offset) const {
    if (offset + bytes.size() > bytes_) throw std::out_of_range("download past the end of a buffer");
    note("download", this, nullptr);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(handle_, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes.size()),
                            bytes.data());
}

void Buffer::release() {
    if (handle_) {
        glDeleteBuffers(1, &handle_);
        all_bytes -= bytes_;
    }
    handle_ = 0;
    mapped_ = nullptr;
}

std::size_t bytesOfBuffers() {
    return all_bytes;
}

BufferCount::BufferCount() {
    if (counting) throw std::logic_error("buffers are being counted already");
    counting = this;
}

BufferCount::~BufferCount() {
    counting = nullptr;
}

BufferCount* BufferCount::kept() {
    return counting;
}

std::size_t BufferCount::bytes() const {
    std::size_t sum = 0;
    for (const Counted& each : buffers_)
        sum += each.bytes;
    return sum;
}

WordTexture::WordTexture(const Buffer& buffer, Texel texel) : contents_(buffer.contents()) {
    if (BufferCount::kept()) return;
    const std::size_t bytes = texel == Texel::one_word ? 4 : texel == Texel::two_words ? 8 : 16;
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
    if (buffer.bytes() / bytes > static_cast<std::size_t>(limit))
        throw GraphicsError(
            fmt::format("a buffer of {} texels is more than the {} that this device can sample",
                        buffer.bytes() / bytes, limit));
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &handle_);
    const GLenum format = texel == Texel::one_word    ? GL_R32UI
                          : texel == Texel::two_words ? GL_RG32UI
                                                      : GL_RGBA32UI;
    glTextureBuffer(handle_, format, buffer.handle());
}

WordTexture::~WordTexture() {
    if (handle_) glDeleteTextures(1, &handle_);
}

WordTexture::WordTexture(WordTexture&& other) noexcept
    : handle_(std::exchange(other.handle_, 0)), contents_(std::move(other.contents_)) {}

WordTexture& WordTexture::operator=(WordTexture&& other) noexcept {
    std::swap(handle_, other.handle_);
    std::swap(contents_, other.contents_);
    return *this;
}

}  // namespace throng::gl
