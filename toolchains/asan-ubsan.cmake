# SPDX-License-Identifier: Apache-2.0
# Memory errors and undefined behaviour; libFuzzer, which tests/fuzz links, is clang's only.
set(CMAKE_C_COMPILER clang)
set(CMAKE_CXX_COMPILER clang++)
set(ORBWATCH_SANITIZE address,undefined CACHE STRING "")
