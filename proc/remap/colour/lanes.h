// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The arithmetic of colour conversion for a run, in Q14 integers of 32 bits: `lanes_neon.h` where
/// compilers do not generate the processor's instructions by themselves, else `lanes_any.h`, whose
/// loops become vector code. The results are equal.
#ifdef __aarch64__
#include "proc/remap/colour/lanes_neon.h"
#else
#include "proc/remap/colour/lanes_any.h"
#endif
