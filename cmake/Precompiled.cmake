# SPDX-License-Identifier: Apache-2.0
# What nearly every file includes, parsed once for all: 90 MB of a build, and seconds of a compiler, where every target
# had its own. Files still include what they use: scripts/tidy looks at them without this.
set(throng_precompiled_headers
    <algorithm> <array> <filesystem> <functional> <map> <optional> <span> <string> <string_view> <vector>
    <fmt/format.h> <glm/glm.hpp>)

# Gives throng_base's precompiled headers to all targets of a folder and those below it that have none of their own.
function(throng_share_precompiled folder)
    get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
    foreach(target IN LISTS targets)
        get_target_property(type ${target} TYPE)
        get_target_property(own ${target} PRECOMPILE_HEADERS)
        get_target_property(runs_once ${target} THRONG_RUNS_ONCE)
        if(type MATCHES "EXECUTABLE|STATIC_LIBRARY" AND NOT own)
            if(runs_once)
                target_precompile_headers(${target} REUSE_FROM throng_test_base)
            else()
                target_precompile_headers(${target} REUSE_FROM throng_base)
            endif()
        endif()
    endforeach()
    get_property(below DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
    foreach(each IN LISTS below)
        throng_share_precompiled(${each})
    endforeach()
endfunction()
