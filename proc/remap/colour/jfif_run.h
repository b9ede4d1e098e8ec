// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Luma and chroma of JFIF for a run of pixels: `jfif_run_neon.h` where compilers do not generate
/// the processor's instructions by themselves, else `jfif_run_any.h`, whose loops become vector
/// code. The results are equal.
#ifdef __aarch64__
#include "proc/remap/colour/jfif_run_neon.h"
#else
#include "proc/remap/colour/jfif_run_any.h"
#endif
