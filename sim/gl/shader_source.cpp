// SPDX-License-Identifier: Apache-2.0
#include "sim/gl/shader_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "base/files/input_file.h"
#include "sim/gl/context.h"
#include "sim/gl/embedded_shaders.h"

namespace throng::gl {

std::string ShaderLibrary::readFile(const std::string& path) const {
    if (!folder_.empty()) {
        const std::filesystem::path on_disk =
            folder_ / std::filesystem::path(path).lexically_relative("shaders");
        constexpr std::uint64_t kMostBytes = std::uint64_t{4} << 20;
        std::error_code none;
        if (std::filesystem::exists(on_disk, none)) return throng::readFile(on_disk, kMostBytes);
    }
    for (const EmbeddedShader& shader : embeddedShaders())
        if (shader.path == path) return std::string(shader.text);
    throw GraphicsError(fmt::format("there is no shader `{}`", path));
}

void ShaderLibrary::append(const std::string& path, std::vector<std::string>& files, std::string& out) const {
    if (std::find(files.begin(), files.end(), path) != files.end()) return;
    const std::size_t number = files.size();
    files.push_back(path);
    out += fmt::format("#line 1 {}\n", number);
    std::istringstream lines(readFile(path));
    std::string line;
    for (int line_number = 1; std::getline(lines, line); ++line_number) {
        if (line.starts_with("#include")) {
            const std::size_t open = line.find('"');
            const std::size_t close = line.rfind('"');
            // Angle brackets name C++ headers: they are not for this compiler.
            if (open != std::string::npos && close > open)
                append(line.substr(open + 1, close - open - 1), files, out);
            out += fmt::format("#line {} {}\n", line_number + 1, number);
            continue;
        }
        out += line;
        out += '\n';
    }
}

std::string ShaderLibrary::load(const std::string& path, const Definitions& definitions,
                                std::vector<std::string>& files) const {
    files.clear();
    std::string body;
    append(path, files, body);
    std::string out = "#version 450 core\n";
    for (const auto& [name, value] : definitions)
        if (body.find(name) != std::string::npos) out += fmt::format("#define {} {}\n", name, value);
    return out + body;
}

}  // namespace throng::gl
