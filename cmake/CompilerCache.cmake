# SPDX-License-Identifier: Apache-2.0
# What ccache has compiled once, in whatever folder, is not compiled again: a second clone is built in seconds. ccache
# wants to be told that precompiled headers may be cached, and that paths below this folder are no difference. Clang is
# given the whole path of its precompiled headers, and so finds again only what was compiled in the same folder.
find_program(THRONG_CCACHE ccache)
if(THRONG_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1
        CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${THRONG_CCACHE})
    add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
                        "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endif()
