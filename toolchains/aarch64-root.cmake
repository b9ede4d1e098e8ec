# arm64 with Debian's cross compiler against an unpacked Debian root that holds the libraries, whose
# folder ORBWATCH_ROOT names.
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES ORBWATCH_ROOT)
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_SYSROOT ${ORBWATCH_ROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${ORBWATCH_ROOT})
set(ENV{PKG_CONFIG_LIBDIR}
    ${ORBWATCH_ROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${ORBWATCH_ROOT}/usr/share/pkgconfig)
# Test programs run where the libraries are, not here: their cases are listed when they run.
set(CMAKE_GTEST_DISCOVER_TESTS_DISCOVERY_MODE PRE_TEST)
