# Memory errors and undefined behaviour, with the system's compiler.
set(ORBWATCH_SANITIZE address,undefined CACHE STRING "")
