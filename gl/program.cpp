// SPDX-License-Identifier: MIT
#include "gl/program.h"

#include <fmt/format.h>

#include <vector>

#include "core/error.h"

namespace spindrift::gl
{

namespace
{

struct ShaderKind
{
    static void free(GLuint name) { glDeleteShader(name); }
};
using Shader = Object<ShaderKind>;

constexpr int kDeepestInclude = 4;

std::string expanded(std::string_view file, int depth)
{
    if (depth > kDeepestInclude) throw Error(fmt::format("shader {}: #include goes too deep", file));
    constexpr std::string_view include = "#include \"";
    std::string out;
    std::string_view rest = shader_source(file);
    while (!rest.empty())
    {
        const std::size_t end = rest.find('\n');
        const std::string_view line = rest.substr(0, end);
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
        if (line.starts_with(include))
            out += expanded(line.substr(include.size(), line.rfind('"') - include.size()), depth + 1);
        else
            out.append(line).push_back('\n');
    }
    return out;
}

GLenum stage_of(std::string_view file)
{
    if (file.ends_with(".vert")) return GL_VERTEX_SHADER;
    if (file.ends_with(".frag")) return GL_FRAGMENT_SHADER;
    if (file.ends_with(".comp")) return GL_COMPUTE_SHADER;
    throw Error(fmt::format("shader {}: the name must end in .vert, .frag or .comp", file));
}

std::string first_line(const std::string& text)
{
    return text.substr(0, text.find('\n'));
}

Shader compile(std::string_view file, const std::string& head)
{
    Shader shader(glCreateShader(stage_of(file)));
    const std::string text = head + expanded(file, 0);
    const char* source = text.c_str();
    glShaderSource(shader.name(), 1, &source, nullptr);
    glCompileShader(shader.name());
    GLint ok = GL_FALSE;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &ok);
    if (ok == GL_TRUE) return shader;
    GLint length = 0;
    glGetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length) + 1, '\0');
    glGetShaderInfoLog(shader.name(), length, nullptr, log.data());
    throw Error(fmt::format("shader {} does not compile: {}", file, first_line(log)));
}

}  // namespace

Program make_program(std::span<const std::string_view> files, std::span<const std::string_view> defines)
{
    std::string head = "#version 450 core\n";
    for (const std::string_view define : defines) head += fmt::format("#define {}\n", define);
    Program program(glCreateProgram());
    std::vector<Shader> shaders;
    std::string names;
    for (const std::string_view file : files)
    {
        shaders.push_back(compile(file, head));
        glAttachShader(program.name(), shaders.back().name());
        names += names.empty() ? std::string(file) : fmt::format(", {}", file);
    }
    glLinkProgram(program.name());
    GLint ok = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &ok);
    if (ok == GL_TRUE) return program;
    GLint length = 0;
    glGetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length) + 1, '\0');
    glGetProgramInfoLog(program.name(), length, nullptr, log.data());
    throw Error(fmt::format("shaders {} do not link: {}", names, first_line(log)));
}

}  // namespace spindrift::gl
