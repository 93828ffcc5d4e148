# SPDX-License-Identifier: Apache-2.0
# throng_motion_table(SCHEMA OUTPUT): writes OUTPUT, a C++ source that defines throng::motionParameters() as the table
# in the property `motion` of the layout's SCHEMA.
function(throng_motion_table schema output)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${schema})
    file(READ ${schema} text)
    string(JSON rules GET "${text}" properties motion properties)
    string(JSON rule_count LENGTH "${rules}")
    math(EXPR last_rule "${rule_count} - 1")
    set(rows "")
    foreach(number RANGE ${last_rule})
        string(JSON rule MEMBER "${rules}" ${number})
        string(JSON parameters GET "${rules}" ${rule} properties)
        string(JSON parameter_count LENGTH "${parameters}")
        math(EXPR last_parameter "${parameter_count} - 1")
        foreach(index RANGE ${last_parameter})
            string(JSON name MEMBER "${parameters}" ${index})
            string(JSON type GET "${parameters}" ${name} type)
            string(JSON value GET "${parameters}" ${name} default)
            if(type STREQUAL "boolean")
                string(REPLACE "ON" "1" value ${value})
                string(REPLACE "OFF" "0" value ${value})
                string(APPEND rows "    {\"${rule}\", \"${name}\", true, ${value}, 0, 1},\n")
            else()
                string(JSON least GET "${parameters}" ${name} minimum)
                string(JSON most GET "${parameters}" ${name} maximum)
                string(APPEND rows "    {\"${rule}\", \"${name}\", false, ${value}, ${least}, ${most}},\n")
            endif()
        endforeach()
    endforeach()
    file(CONFIGURE OUTPUT ${output} @ONLY CONTENT "#include \"base/motion_settings.h\"

namespace throng {
namespace {
constexpr MotionParameter kRows[] = {
@rows@};
}
std::span<const MotionParameter> motionParameters() { return kRows; }
}
")
endfunction()
