# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` brings beside the program, and the packages that `cpack` makes of it. Nothing that is installed
# knows where it lies: the folder may be moved.
include(GNUInstallDirs)
find_package(Python3 COMPONENTS Interpreter)

set(share ${CMAKE_BINARY_DIR}/share)
file(MAKE_DIRECTORY ${share})
# throng_says(FILE ARGUMENT...): what the program prints, as a file.
function(throng_says file)
    add_custom_command(OUTPUT ${share}/${file}
        COMMAND $<TARGET_FILE:throng> ${ARGN} > ${share}/${file}
        DEPENDS throng
        COMMENT "Writing ${file}"
        VERBATIM)
    set_property(GLOBAL APPEND PROPERTY throng_said ${share}/${file})
endfunction()
throng_says(throng.1 manual)
throng_says(throng.bash completions bash)
throng_says(_throng completions zsh)
throng_says(throng.fish completions fish)
get_property(said GLOBAL PROPERTY throng_said)

if(Python3_FOUND)
    file(GLOB_RECURSE addon_files CONFIGURE_DEPENDS blender_addon/throng/*.py blender_addon/throng/*.toml)
    set(addon ${share}/throng-blender.zip)
    add_custom_command(OUTPUT ${addon}
        COMMAND Python3::Interpreter scripts/build_addon.py ${addon}
        DEPENDS ${addon_files} scripts/build_addon.py authoring/layout/throng-layout.schema.json
        WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
        COMMENT "Packing the Blender add-on"
        VERBATIM)
    install(FILES ${addon} DESTINATION ${CMAKE_INSTALL_DATADIR}/throng)
else()
    message(STATUS "there is no Python: installs come without the Blender add-on")
endif()
add_custom_target(package_files ALL DEPENDS ${said} ${addon})

install(FILES ${share}/throng.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${share}/throng.bash RENAME throng DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${share}/_throng DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES ${share}/throng.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
file(GLOB_RECURSE schemas CONFIGURE_DEPENDS analysis/*.schema.json authoring/*.schema.json cli/*.schema.json
    io/*.schema.json)
install(FILES ${schemas} DESTINATION ${CMAKE_INSTALL_DATADIR}/throng/schemas)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/throng)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN "*.css" EXCLUDE)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE RENAME copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
# Libraries of headers are in the program, and their terms ask to be told; the others come as packages of their own.
foreach(package IN ITEMS libcli11-dev libglm-dev libsqlitecpp-dev libtinygltf-dev nlohmann-json3-dev libfmt-dev)
    install(FILES /usr/share/doc/${package}/copyright RENAME ${package}.txt OPTIONAL
        DESTINATION ${CMAKE_INSTALL_DOCDIR}/licences)
endforeach()

set(CPACK_GENERATOR DEB TXZ)
set(CPACK_PACKAGE_NAME throng)
set(CPACK_PACKAGE_VENDOR Throng)
set(CPACK_PACKAGE_CONTACT "The Throng authors <throng@throng.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_FILE_NAME throng-${PROJECT_VERSION}-linux-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# OpenGL is looked for when it is needed, which no tool that looks at the program can see.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libegl1, libopengl0")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libgl1-mesa-dri, fonts-dejavu-core")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "blender, ffmpeg")
set(CPACK_ARCHIVE_THREADS 0)
include(CPack)
