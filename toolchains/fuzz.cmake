# For libFuzzer, which only clang has: with memory errors and undefined behaviour watched.
set(CMAKE_C_COMPILER clang)
set(CMAKE_CXX_COMPILER clang++)
set(ORBWATCH_SANITIZE address,undefined,fuzzer-no-link CACHE STRING "")
