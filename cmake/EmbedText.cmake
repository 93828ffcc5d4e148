# SPDX-License-Identifier: Apache-2.0
# throng_cut_text(TEXT TAG OUT): TEXT as raw string literals with the delimiter TAG, none too long for compilers.
function(throng_cut_text text tag out)
    string(LENGTH "${text}" length)
    set(pieces "")
    set(from 0)
    while(from LESS length)
        string(SUBSTRING "${text}" ${from} 8000 piece)
        string(APPEND pieces "R\"${tag}(${piece})${tag}\"\n")
        math(EXPR from "${from} + 8000")
    endwhile()
    set(${out} "${pieces}" PARENT_SCOPE)
endfunction()

# throng_embed_schema(FILE FUNCTION HEADER [ROOM]): writes FUNCTION.cpp into the build folder, which defines
# std::string_view throng::ROOM::FUNCTION(), declared in HEADER, as the content of FILE. ROOM is authoring unless told.
function(throng_embed_schema file function header)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} text)
    set(room authoring)
    if(ARGC GREATER 3)
        set(room ${ARGV3})
    endif()
    throng_cut_text("${text}" schema pieces)
    file(CONFIGURE OUTPUT ${function}.cpp @ONLY CONTENT
"#include \"@header@\"

namespace throng::@room@ {
std::string_view @function@() {
    return
@pieces@;
}
}
")
endfunction()
