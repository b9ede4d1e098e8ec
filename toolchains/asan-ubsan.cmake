# Memory errors and undefined behaviour, with coverage for libFuzzer, which only clang has.
set(CMAKE_C_COMPILER clang)
set(CMAKE_CXX_COMPILER clang++)
set(ORBWATCH_SANITIZE address,undefined,fuzzer-no-link CACHE STRING "")
