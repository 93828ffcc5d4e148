# SPDX-License-Identifier: Apache-2.0
cmake_minimum_required(VERSION 3.25)
# Writes OUTPUT, the source file of base/build_name.h, when the name of the state of ROOT has changed.
set(name unknown)
set(found "")
find_program(git git)
if(git)
    execute_process(COMMAND ${git} -C ${ROOT} rev-parse --show-toplevel
        OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    file(REAL_PATH ${ROOT} root)
    # Sources that were unpacked inside somebody else's checkout have no commit of their own.
    if(top STREQUAL root)
        execute_process(COMMAND ${git} -C ${ROOT} describe --tags --always --dirty --abbrev=12
            OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    endif()
    if(found MATCHES "^[A-Za-z0-9._/+-]+$")
        set(name ${found})
    endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT
"#include \"base/build_name.h\"

namespace throng {
std::string_view buildName() { return \"@name@\"; }
}
")
