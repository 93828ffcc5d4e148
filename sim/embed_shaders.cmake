# SPDX-License-Identifier: Apache-2.0
# cmake -DOUTPUT=file.cpp -DROOT=project -P embed_shaders.cmake
# Writes every file of shaders/ into a C++ source, as raw strings cut below the compilers' length limit.
include(${ROOT}/cmake/EmbedText.cmake)
file(GLOB_RECURSE paths RELATIVE ${ROOT} ${ROOT}/shaders/*.comp ${ROOT}/shaders/*.vert ${ROOT}/shaders/*.frag
     ${ROOT}/shaders/*.glsl ${ROOT}/shaders/*.h)
list(SORT paths)
set(entries "")
foreach(path IN LISTS paths)
    file(READ ${ROOT}/${path} text)
    throng_cut_text("${text}" embedded pieces)
    # Counted by the compiler's front end: clang gives up on constants that take a million steps to count.
    string(STRIP "${pieces}" pieces)
    string(APPEND entries "    {\"${path}\", ${pieces}sv},\n")
endforeach()
file(WRITE ${OUTPUT}.new "#include \"sim/gl/embedded_shaders.h\"\n\nnamespace throng::gl {\nnamespace {\n"
     "using std::string_view_literals::operator\"\"sv;\n"
     "constexpr EmbeddedShader kShaders[] = {\n${entries}};\n}\n"
     "std::span<const EmbeddedShader> embeddedShaders() { return kShaders; }\n}\n")
file(COPY_FILE ${OUTPUT}.new ${OUTPUT} ONLY_IF_DIFFERENT)
file(REMOVE ${OUTPUT}.new)
