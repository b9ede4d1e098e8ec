# SPDX-License-Identifier: Apache-2.0
# Data races, with the system's compiler.
set(ORBWATCH_SANITIZE thread CACHE STRING "")
