// SPDX-License-Identifier: Apache-2.0
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "sim/gl/context.h"

namespace throng::gl {
namespace {

/// What a pass wrote may next be read as storage or uniforms, as dispatch arguments, by copies, or through a
/// sampler.
constexpr GLbitfield kWritesVisible = GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                                      GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                                      GL_UNIFORM_BARRIER_BIT;

GLenum stageOf(const std::string& path) {
    if (path.ends_with(".comp")) return GL_COMPUTE_SHADER;
    if (path.ends_with(".vert")) return GL_VERTEX_SHADER;
    if (path.ends_with(".frag")) return GL_FRAGMENT_SHADER;
    throw std::logic_error("unknown kind of shader: " + path);
}

std::string infoLog(GLuint object, bool is_program) {
    GLint length = 0;
    is_program ? glGetProgramiv(object, GL_INFO_LOG_LENGTH, &length)
               : glGetShaderiv(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    is_program ? glGetProgramInfoLog(object, length, nullptr, log.data())
               : glGetShaderInfoLog(object, length, nullptr, log.data());
    return log.c_str();
}

/// @param allowed gets what the text lets the program do
GLuint compile(const ShaderLibrary& library, const std::string& path, const Definitions& definitions,
               std::vector<Access>& allowed) {
    std::vector<std::string> files;
    const std::string source = library.load(path, definitions, files);
    for (const Access& access : accessIn(source))
        addAccess(allowed, access);
    const GLuint shader = glCreateShader(stageOf(path));
    const char* text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled) return shader;
    std::string message = fmt::format("the driver cannot compile {}:\n{}", path, infoLog(shader, false));
    for (std::size_t i = 0; i < files.size(); ++i)
        message += fmt::format("  (file {} is {})\n", i, files[i]);
    glDeleteShader(shader);
    throw GraphicsError(message);
}

std::string resourceName(GLuint program, GLenum interface, GLuint index) {
    char name[128] = {};
    glGetProgramResourceName(program, interface, index, sizeof name, nullptr, name);
    return name;
}

}  // namespace

ProgramPool::~ProgramPool() {
    for (const auto& [key, programs] : idle_)
        for (const LinkedProgram& program : programs)
            glDeleteProgram(program.handle);
}

LinkedProgram ProgramPool::take(const std::string& key) {
    const auto found = idle_.find(key);
    if (found == idle_.end() || found->second.empty()) return {};
    LinkedProgram program = std::move(found->second.back());
    found->second.pop_back();
    return program;
}

void ProgramPool::giveBack(const std::string& key, LinkedProgram program) {
    idle_[key].push_back(std::move(program));
}

void ShaderLibrary::keepPrograms() {
    pool_ = std::make_shared<ProgramPool>();
}

Program::Program(const ShaderLibrary& library, const Declaration& declaration, const Definitions& definitions)
    : declaration_(declaration), pool_(library.pool()) {
    for (const std::string& path : declaration.shaders)
        name_ += (name_.empty() ? "" : " + ") + path;
    key_ = name_;
    for (const auto& [word, value] : definitions)
        key_ += fmt::format("\n{}={}", word, value);
    if (pool_) linked_ = pool_->take(key_);
    if (!linked_.handle) link(library, definitions);
    // Bindings and uniforms of an earlier life do not count: reflection forgets them.
    reflect();
    declaration_.check(linked_.allowed, active());
}

void Program::link(const ShaderLibrary& library, const Definitions& definitions) {
    const GLuint handle = linked_.handle = glCreateProgram();
    std::vector<GLuint> shaders;
    for (const std::string& path : declaration_.shaders) {
        shaders.push_back(compile(library, path, definitions, linked_.allowed));
        glAttachShader(handle, shaders.back());
    }
    glLinkProgram(handle);
    for (GLuint shader : shaders) {
        glDetachShader(handle, shader);
        glDeleteShader(shader);
    }
    GLint linked = 0;
    glGetProgramiv(handle, GL_LINK_STATUS, &linked);
    if (!linked)
        throw GraphicsError(fmt::format("the driver cannot link {}:\n{}", name_, infoLog(handle, true)));
    glObjectLabel(GL_PROGRAM, handle, static_cast<GLsizei>(name_.size()), name_.c_str());
}

void Program::reflect() {
    const auto active = [this](GLenum interface) {
        GLint count = 0;
        glGetProgramInterfaceiv(handle(), interface, GL_ACTIVE_RESOURCES, &count);
        return static_cast<GLuint>(count);
    };
    const auto add = [this](GLenum interface, GLenum target, GLuint index) {
        Block found;
        found.name = resourceName(handle(), interface, index);
        found.target = target;
        found.binding = index;
        blocks_.push_back(std::move(found));
    };
    for (GLuint index = 0; index < active(GL_SHADER_STORAGE_BLOCK); ++index) {
        add(GL_SHADER_STORAGE_BLOCK, GL_SHADER_STORAGE_BUFFER, index);
        glShaderStorageBlockBinding(handle(), index, index);
    }
    for (GLuint index = 0; index < active(GL_UNIFORM_BLOCK); ++index) {
        add(GL_UNIFORM_BLOCK, GL_UNIFORM_BUFFER, index);
        glUniformBlockBinding(handle(), index, index);
    }
    for (GLuint index = 0; index < active(GL_UNIFORM); ++index) {
        const std::string uniform_name = resourceName(handle(), GL_UNIFORM, index);
        const GLint location = glGetUniformLocation(handle(), uniform_name.c_str());
        if (location >= 0)
            uniforms_.push_back({uniform_name, location, false});  // members of blocks have none
    }
}

std::vector<std::string> Program::active() const {
    std::vector<std::string> names;
    for (const Block& each : blocks_)
        names.push_back(each.name);
    for (const Access& access : linked_.allowed)
        if (hasUniform(access.name)) names.push_back(access.name);
    return names;
}

Program::~Program() {
    if (!linked_.handle) return;
    if (pool_)
        pool_->giveBack(key_, std::move(linked_));
    else
        glDeleteProgram(linked_.handle);
}

Program::Program(Program&& other) noexcept {
    *this = std::move(other);
}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(linked_, other.linked_);
    std::swap(declaration_, other.declaration_);
    std::swap(name_, other.name_);
    std::swap(pool_, other.pool_);
    std::swap(key_, other.key_);
    std::swap(blocks_, other.blocks_);
    std::swap(uniforms_, other.uniforms_);
    std::swap(samplers_, other.samplers_);
    return *this;
}

bool Program::hasBlock(const std::string& block) const {
    return std::any_of(blocks_.begin(), blocks_.end(), [&](const Block& b) { return b.name == block; });
}

Program::Block& Program::block(const std::string& name) {
    std::string known;
    for (Block& candidate : blocks_) {
        if (candidate.name == name) return candidate;
        known += " " + candidate.name;
    }
    throw std::logic_error(fmt::format("{} has no block `{}`; it has:{}", name_, name, known));
}

void Program::bind(const std::string& name, const Buffer& buffer) {
    Block& found = block(name);
    found.buffer = buffer.handle();
    found.bytes = 0;
    found.contents = buffer.contents();
}

void Program::bindRange(const std::string& name, const Buffer& buffer, std::size_t first, std::size_t bytes) {
    Block& found = block(name);
    found.buffer = buffer.handle();
    found.first = first;
    found.bytes = bytes;
    found.contents = buffer.contents();
}

void Program::bindAll(const std::vector<std::pair<std::string, const Buffer*>>& buffers) {
    for (const auto& [block, buffer] : buffers)
        if (hasBlock(block)) bind(block, *buffer);
}

void Program::bind(const std::string& sampler, const WordTexture& texture) {
    bindTexture(sampler, texture.handle(), texture.contents());
}

void Program::bindTexture(const std::string& sampler, std::uint32_t texture,
                          std::shared_ptr<const Contents> contents) {
    for (Sampler& known : samplers_) {
        if (known.name != sampler) continue;
        known.texture = texture;
        known.contents = std::move(contents);
        return;
    }
    const auto unit = static_cast<std::uint32_t>(samplers_.size());
    glProgramUniform1i(handle(), uniform(sampler).location, static_cast<GLint>(unit));
    samplers_.push_back({sampler, unit, texture, std::move(contents)});
}

bool Program::hasUniform(const std::string& name) const {
    return std::any_of(uniforms_.begin(), uniforms_.end(), [&](const Uniform& u) { return u.name == name; });
}

Program::Uniform& Program::uniform(const std::string& name) {
    for (Uniform& candidate : uniforms_) {
        if (candidate.name == name) {
            candidate.set = true;
            return candidate;
        }
    }
    throw std::logic_error(fmt::format("{} has no uniform `{}`", name_, name));
}

void Program::set(const std::string& name, std::uint32_t value) {
    glProgramUniform1ui(handle(), uniform(name).location, value);
}
void Program::set(const std::string& name, float value) {
    glProgramUniform1f(handle(), uniform(name).location, value);
}
void Program::set(const std::string& name, glm::vec2 value) {
    glProgramUniform2f(handle(), uniform(name).location, value.x, value.y);
}
void Program::set(const std::string& name, glm::uvec2 value) {
    glProgramUniform2ui(handle(), uniform(name).location, value.x, value.y);
}

void Program::use() const {
    for (const Block& each : blocks_) {
        if (!each.buffer)
            throw std::logic_error(fmt::format("{}: no buffer is bound to `{}`", name_, each.name));
        if (each.bytes)
            glBindBufferRange(each.target, each.binding, each.buffer, static_cast<GLintptr>(each.first),
                              static_cast<GLsizeiptr>(each.bytes));
        else
            glBindBufferBase(each.target, each.binding, each.buffer);
    }
    for (const Uniform& candidate : uniforms_)
        if (!candidate.set)
            throw std::logic_error(fmt::format("{}: uniform `{}` was never set", name_, candidate.name));
    for (const Sampler& sampler : samplers_)
        glBindTextureUnit(sampler.unit, sampler.texture);
    glUseProgram(handle());
    if (Journal* journal = Journal::kept()) journal->note(name_, touches(), declaration_.pass);
}

std::vector<Touch> Program::touches() const {
    std::vector<Touch> touches;
    for (const Block& each : blocks_)
        touches.push_back(
            {each.contents, declaration_.readsFrom(each.name), declaration_.writesTo(each.name)});
    for (const Sampler& sampler : samplers_)
        touches.push_back({sampler.contents, true, false});
    return touches;
}

ComputeProgram::ComputeProgram(const ShaderLibrary& library, const Declaration& declaration,
                               const Definitions& definitions)
    : Program(library, declaration, definitions) {
    GLint size[3] = {1, 1, 1};
    glGetProgramiv(handle(), GL_COMPUTE_WORK_GROUP_SIZE, size);
    if (size[1] != 1 || size[2] != 1)
        throw std::logic_error(name() + ": groups are expected to be one-dimensional");
    group_size_ = static_cast<std::uint32_t>(size[0]);
}

void ComputeProgram::dispatch(std::uint64_t invocations) const {
    if (invocations == 0) return;
    constexpr std::uint64_t kMostPerAxis = 65535;  // what every device takes
    const std::uint64_t groups = (invocations + group_size_ - 1) / group_size_;
    const std::uint64_t lines = (groups + kMostPerAxis - 1) / kMostPerAxis;
    use();
    glDispatchCompute(static_cast<GLuint>((groups + lines - 1) / lines), static_cast<GLuint>(lines), 1);
    glMemoryBarrier(kWritesVisible);
}

void ComputeProgram::dispatchIndirect(const Buffer& arguments, std::size_t offset) const {
    use();
    if (Journal* journal = Journal::kept()) journal->noteAlso({arguments.contents(), true, false});
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, arguments.handle());
    glDispatchComputeIndirect(static_cast<GLintptr>(offset));
    glMemoryBarrier(kWritesVisible);
}

void ComputeProgram::dispatchUpTo(std::uint64_t most, const Buffer& arguments) const {
    // An NVIDIA H100: 1.7 us less a launch (docs/benchmarks/h100); llvmpipe would run them all for nothing.
    constexpr std::uint64_t kWorthStarting = 65536;
    if (Context::currentIsSoftware() || most > kWorthStarting)
        dispatchIndirect(arguments);
    else
        dispatch(most);
}

}  // namespace throng::gl
