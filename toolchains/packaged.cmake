# SPDX-License-Identifier: Apache-2.0
# The Debian packages' compiler and linker options (dpkg-buildflags, with the choices of
# platform/debian/rules), and where the packages install: `platform/build-deb --here` packs this build.
find_program(ORBWATCH_BUILDFLAGS dpkg-buildflags)
if(NOT ORBWATCH_BUILDFLAGS)
  message(FATAL_ERROR "dpkg-buildflags is missing: apt install dpkg-dev")
endif()
cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH orbwatch_project)
function(orbwatch_packaged_options variable)
  set(options)
  foreach(flags IN LISTS ARGN)
    execute_process(
      COMMAND make --silent --no-print-directory --file platform/debian/rules flags-${flags}
      WORKING_DIRECTORY ${orbwatch_project}
      OUTPUT_VARIABLE some OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    string(APPEND options " ${some}")
  endforeach()
  string(STRIP "${options}" options)
  set(${variable} "${options}" PARENT_SCOPE)
endfunction()
if(NOT DEFINED CMAKE_CXX_FLAGS_INIT)
  orbwatch_packaged_options(CMAKE_C_FLAGS_INIT CFLAGS CPPFLAGS)
  orbwatch_packaged_options(CMAKE_CXX_FLAGS_INIT CXXFLAGS CPPFLAGS)
  orbwatch_packaged_options(CMAKE_EXE_LINKER_FLAGS_INIT LDFLAGS)
  set(CMAKE_MODULE_LINKER_FLAGS_INIT "${CMAKE_EXE_LINKER_FLAGS_INIT}")
  set(CMAKE_SHARED_LINKER_FLAGS_INIT "${CMAKE_EXE_LINKER_FLAGS_INIT}")
endif()
set(CMAKE_INSTALL_PREFIX /usr CACHE PATH "Where the packages install")
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
