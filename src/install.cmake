# SPDX-License-Identifier: GPL-2.0-or-later
# cmake --install: find_package(qmorph) gives qmorph::qmorph, and qmorph::gmsh where COMPONENTS gmsh is asked for.
include(CMakePackageConfigHelpers)
set(package_directory ${CMAKE_INSTALL_LIBDIR}/cmake/qmorph)
target_include_directories(qmorph INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

# install_library(TARGET EXPORT): the library, and what find_package() reads of it.
function(install_library target export)
  install(TARGETS ${target} EXPORT ${export}
    LIBRARY COMPONENT library NAMELINK_COMPONENT development
    ARCHIVE COMPONENT development)
  install(EXPORT ${export} NAMESPACE qmorph:: DESTINATION ${package_directory} COMPONENT development)
endfunction()

install(DIRECTORY include/qmorph DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install_library(qmorph qmorph-core)
if(QMORPH_COMMAND)
  install_library(qmorph_gmsh qmorph-gmsh)
  install(FILES src/gmsh/FindGmshSDK.cmake DESTINATION ${package_directory} COMPONENT development)

  install(TARGETS qmorph_command COMPONENT command)
  install(FILES src/cli/completion.bash RENAME qmorph DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
    COMPONENT command)
  # The manual page is what --help says, in the form of man.
  find_program(HELP2MAN help2man)
  find_program(GZIP gzip)
  mark_as_advanced(HELP2MAN GZIP)
  if(HELP2MAN AND GZIP)
    set(text ${PROJECT_BINARY_DIR}/qmorph.1)
    set(manual ${text}.gz)
    add_custom_command(OUTPUT ${manual}
      COMMAND ${HELP2MAN} --no-info --name "${PROJECT_DESCRIPTION}" --output ${text} $<TARGET_FILE:qmorph_command>
      COMMAND ${GZIP} --best --no-name --force --keep ${text}
      DEPENDS qmorph_command VERBATIM)
    add_custom_target(qmorph_manual ALL DEPENDS ${manual})
    # tools/run builds the command alone: what it has built can be installed, too.
    install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command OPTIONAL)
  endif()
endif()

set(QMORPH_SHARED ${BUILD_SHARED_LIBS})
file(CONFIGURE OUTPUT qmorph-config.cmake @ONLY CONTENT [[
include(CMakeFindDependencyMacro)
if(NOT TARGET Eigen3::Eigen)
  find_dependency(Eigen3 NO_MODULE)
endif()
# What static libraries are linked with.
set(qmorph_is_shared "@QMORPH_SHARED@")
if(NOT qmorph_is_shared)
  find_dependency(TBB)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/qmorph-core.cmake)
if("gmsh" IN_LIST qmorph_FIND_COMPONENTS)
  if(NOT EXISTS ${CMAKE_CURRENT_LIST_DIR}/qmorph-gmsh.cmake)
    set(qmorph_FOUND FALSE)
    set(qmorph_NOT_FOUND_MESSAGE "qmorph was installed without the Gmsh adapter (QMORPH_COMMAND)")
    return()
  endif()
  if(NOT qmorph_is_shared)
    list(PREPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
    find_dependency(GmshSDK)
    list(POP_FRONT CMAKE_MODULE_PATH)
    find_dependency(fmt 9)
  endif()
  include(${CMAKE_CURRENT_LIST_DIR}/qmorph-gmsh.cmake)
endif()
]])
write_basic_package_version_file(qmorph-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/qmorph-config.cmake ${PROJECT_BINARY_DIR}/qmorph-config-version.cmake
  DESTINATION ${package_directory} COMPONENT development)

# cpack -G DEB makes Debian's packages (tools/package does all of it).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the qmorph developers <qmorph@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL library development command)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
# What the libraries and programs are linked with, our own apart: dpkg cannot know those before they are installed.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src)
# What other packages that are linked with the libraries depend on, and that the loader's cache is renewed.
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
file(WRITE ${PROJECT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/triggers)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libqmorph${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "Shared libraries.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libqmorph-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers for C++20 programs, and what find_package(qmorph) reads.")
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS library)
set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME qmorph)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION math)
set(CPACK_COMPONENT_COMMAND_DESCRIPTION "The command, in the place of gmsh -2.")
if(QMORPH_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-qmorph)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  # A module of one version of Python.
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS python3-gmsh)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-meshio, python3-tqdm")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "The Python module.")
  set(CPACK_COMPONENT_PYTHON_DEPENDS library)
endif()
# Debian has the text of the licence once for all packages.
file(WRITE ${PROJECT_BINARY_DIR}/copyright "qmorph: ${PROJECT_DESCRIPTION}
Copyright: (C) ${CPACK_PACKAGE_CONTACT}
License: GPL-2.0-or-later

This program is free software; you can redistribute it and/or modify it under the terms of the GNU General Public License as
published by the Free Software Foundation; either version 2 of the License, or (at your option) any later version. It comes
without any warranty. On Debian systems the text of the license is in /usr/share/common-licenses/GPL-2.
")
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  install(FILES ${PROJECT_BINARY_DIR}/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME} COMPONENT ${component})
endforeach()
include(CPack)
