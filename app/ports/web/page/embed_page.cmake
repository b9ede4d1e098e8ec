# SPDX-License-Identifier: Apache-2.0
# Writes page_files.cpp into the folder in which it runs: the files NAMES of its folder page, each as it
# is and as NAME.gz, which gzip made of it.
set(ORBWATCH_PAGE "")
foreach(name IN LISTS NAMES)
  set(row "\"${name}\"")
  foreach(file ${name} ${name}.gz)
    file(READ page/${file} bytes HEX)
    string(REGEX REPLACE ".." "\\\\x\\0" bytes "${bytes}")
    string(APPEND row ", \"${bytes}\"sv")
  endforeach()
  string(APPEND ORBWATCH_PAGE "    {${row}},\n")
endforeach()
file(READ ${CMAKE_CURRENT_LIST_DIR}/page_files.cpp.in source)
string(CONFIGURE "${source}" source @ONLY)
# Written even if nothing changed, so that it is newer than what it is made from.
file(WRITE page_files.cpp "${source}")
