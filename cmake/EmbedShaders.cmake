# SPDX-License-Identifier: MIT
# cmake -D OUTPUT=x.cpp -D FILES="a;b" -P EmbedShaders.cmake: writes the texts of the files as one C++ table.
set(table "")
foreach(file IN LISTS FILES)
    get_filename_component(name ${file} NAME)
    file(READ ${file} text)
    string(APPEND table "    {\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// SPDX-License-Identifier: MIT
// Made from shaders/ by cmake/EmbedShaders.cmake.
#include \"gl/program.h\"

#include \"core/error.h\"

namespace spindrift::gl
{

namespace
{

struct Source
{
    std::string_view file, text;
};

constexpr Source kSources[] = {
${table}};

}  // namespace

std::string_view shader_source(std::string_view file)
{
    for (const Source& source : kSources)
        if (source.file == file) return source.text;
    throw Error(\"no shader is named \" + std::string(file));
}

}  // namespace spindrift::gl
")
