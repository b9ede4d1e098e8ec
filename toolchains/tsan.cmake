# Data races, with the system's compiler.
set(ORBWATCH_SANITIZE thread CACHE STRING "")
