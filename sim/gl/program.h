// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "sim/gl/buffer.h"
#include "sim/gl/declaration.h"
#include "sim/gl/shader_source.h"

namespace throng::gl {

/// What linking shaders gives.
struct LinkedProgram {
    std::uint32_t handle = 0;
    std::vector<Access> allowed;  ///< by the shaders' text
};

/// Linked programs that nobody uses at the moment, by what they were made from. Compiling takes tens of
/// milliseconds for a simulation's programs: whoever makes one simulation after the other does it once.
class ProgramPool {
  public:
    ProgramPool() = default;
    ~ProgramPool();
    ProgramPool(const ProgramPool&) = delete;
    ProgramPool& operator=(const ProgramPool&) = delete;

    /// @returns handle 0 where there is none
    LinkedProgram take(const std::string& key);
    void giveBack(const std::string& key, LinkedProgram program);

  private:
    std::unordered_map<std::string, std::vector<LinkedProgram>> idle_;
};

/// A linked program and what reflection says it needs. Buffers are bound to block names, uniforms set by
/// name: there are no binding numbers to keep in step, and use() refuses to run with anything missing.
class Program {
  public:
    Program() = default;
    /// @throws GraphicsError when the driver does not take the shaders
    /// @throws std::logic_error when the program touches anything in a way that is not declared
    Program(const ShaderLibrary& library, const Declaration& declaration,
            const Definitions& definitions = {});
    ~Program();
    Program(Program&& other) noexcept;
    Program& operator=(Program&& other) noexcept;

    /// Remembers which buffer serves a storage or uniform block. Buffers must outlive the program's last use.
    /// @throws std::logic_error for a block that the program does not have, naming those it has
    void bind(const std::string& block, const Buffer& buffer);
    /// The same for a part of a buffer, in bytes; `first` has to suit the device's alignment (256 always
    /// does).
    void bindRange(const std::string& block, const Buffer& buffer, std::size_t first, std::size_t bytes);
    /// The same for those of several blocks that the program uses.
    void bindAll(const std::vector<std::pair<std::string, const Buffer*>>& buffers);
    /// Remembers which texture serves a sampler.
    void bind(const std::string& sampler, const WordTexture& texture);
    void bindTexture(const std::string& sampler, std::uint32_t texture,
                     std::shared_ptr<const Contents> contents);
    bool hasBlock(const std::string& block) const;
    bool hasUniform(const std::string& uniform) const;

    /// @throws std::logic_error for a uniform that the program does not have
    void set(const std::string& uniform, std::uint32_t value);
    void set(const std::string& uniform, float value);
    void set(const std::string& uniform, glm::vec2 value);
    void set(const std::string& uniform, glm::uvec2 value);
    /// The same where the compiler has found a use for the uniform.
    template <class Value>
    void setIfUsed(const std::string& uniform, Value value) {
        if (hasUniform(uniform)) set(uniform, value);
    }

    /// Makes the program and its buffers current.
    /// @throws std::logic_error when a block has no buffer or a uniform no value
    void use() const;

    std::uint32_t handle() const { return linked_.handle; }
    const std::string& name() const { return name_; }

  private:
    struct Block {
        std::string name;
        std::uint32_t target = 0;  // storage or uniform buffer
        std::uint32_t binding = 0;
        std::uint32_t buffer = 0;
        std::size_t first = 0;  // bytes; of a part of the buffer
        std::size_t bytes = 0;  // 0 = the whole buffer
        std::shared_ptr<const Contents> contents;
    };
    struct Uniform {
        std::string name;
        int location = -1;
        bool set = false;
    };
    struct Sampler {
        std::string name;
        std::uint32_t unit = 0;
        std::uint32_t texture = 0;
        std::shared_ptr<const Contents> contents;
    };
    Uniform& uniform(const std::string& name);
    Block& block(const std::string& name);
    void link(const ShaderLibrary& library, const Definitions& definitions);
    void reflect();
    std::vector<std::string> active() const;
    std::vector<Touch> touches() const;

    LinkedProgram linked_;
    Declaration declaration_;
    std::string name_;
    std::shared_ptr<ProgramPool> pool_;  // where it goes in the end
    std::string key_;                    // in the pool
    std::vector<Block> blocks_;
    std::vector<Uniform> uniforms_;
    std::vector<Sampler> samplers_;
};

/// A program with one compute shader. Its group size is read back from the compiler, never repeated in C++.
class ComputeProgram : public Program {
  public:
    ComputeProgram() = default;
    ComputeProgram(const ShaderLibrary& library, const Declaration& declaration,
                   const Definitions& definitions = {});

    std::uint32_t groupSize() const { return group_size_; }

    /// Runs at least `invocations` invocations, then makes its writes visible to later commands. Groups that
    /// do not fit one axis go on along the next: such shaders count with shaders/shared/flat_index.glsl.
    void dispatch(std::uint64_t invocations) const;
    /// The same with the number of groups read on the device: three words at `offset` of `arguments`.
    void dispatchIndirect(const Buffer& arguments, std::size_t offset = 0) const;
    /// The same for a program whose invocations know themselves whether there is work for them, and never
    /// more than `most`: a GPU starts that many for nothing sooner than it waits for the arguments.
    void dispatchUpTo(std::uint64_t most, const Buffer& arguments) const;

  private:
    std::uint32_t group_size_ = 1;
};

}  // namespace throng::gl
