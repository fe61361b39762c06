# SPDX-License-Identifier: GPL-2.0-or-later
# find_package(GmshSDK): Gmsh::Gmsh is the library with its headers, Debian's libgmsh-dev or the SDK of gmsh.info
# (CMAKE_PREFIX_PATH names the folder that it was unpacked into).
find_path(GMSH_INCLUDE_DIR gmsh.h)
find_library(GMSH_LIBRARY gmsh)
if(GMSH_INCLUDE_DIR)
  file(STRINGS "${GMSH_INCLUDE_DIR}/gmsh.h" GmshSDK_VERSION REGEX "define GMSH_API_VERSION +\"")
  string(REGEX REPLACE ".*\"(.*)\".*" "\\1" GmshSDK_VERSION "${GmshSDK_VERSION}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(GmshSDK REQUIRED_VARS GMSH_LIBRARY GMSH_INCLUDE_DIR VERSION_VAR GmshSDK_VERSION
  REASON_FAILURE_MESSAGE "Debian: libgmsh-dev, elsewhere the SDK of gmsh.info with its folder in CMAKE_PREFIX_PATH")
if(GmshSDK_FOUND AND NOT TARGET Gmsh::Gmsh)
  add_library(Gmsh::Gmsh UNKNOWN IMPORTED)
  set_target_properties(Gmsh::Gmsh PROPERTIES
    IMPORTED_LOCATION "${GMSH_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${GMSH_INCLUDE_DIR}")
endif()
mark_as_advanced(GMSH_INCLUDE_DIR GMSH_LIBRARY)
