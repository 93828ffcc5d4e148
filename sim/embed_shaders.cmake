# SPDX-License-Identifier: Apache-2.0
# cmake -DOUTPUT=file.cpp -DROOT=project -P embed_shaders.cmake
# Writes every file of shaders/ into a C++ source, as raw strings cut below the compilers' length limit.
file(GLOB_RECURSE paths RELATIVE ${ROOT} ${ROOT}/shaders/*.comp ${ROOT}/shaders/*.vert ${ROOT}/shaders/*.frag
     ${ROOT}/shaders/*.glsl ${ROOT}/shaders/*.h)
list(SORT paths)
set(entries "")
foreach(path IN LISTS paths)
    file(READ ${ROOT}/${path} text)
    string(LENGTH "${text}" length)
    set(pieces "")
    set(from 0)
    while(from LESS length)
        string(SUBSTRING "${text}" ${from} 8000 piece)
        string(APPEND pieces "R\"embedded(${piece})embedded\"\n")
        math(EXPR from "${from} + 8000")
    endwhile()
    string(APPEND entries "    {\"${path}\", ${pieces}},\n")
endforeach()
file(WRITE ${OUTPUT}.new "#include \"sim/gl/embedded_shaders.h\"\n\nnamespace throng::gl {\nnamespace {\n"
     "constexpr EmbeddedShader kShaders[] = {\n${entries}};\n}\n"
     "std::span<const EmbeddedShader> embeddedShaders() { return kShaders; }\n}\n")
file(COPY_FILE ${OUTPUT}.new ${OUTPUT} ONLY_IF_DIFFERENT)
file(REMOVE ${OUTPUT}.new)
