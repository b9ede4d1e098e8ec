#pragma once

#include "proc/remap/kernel.h"

namespace orbwatch::remap {

#if defined(__aarch64__)
extern const Kernel kNeonKernel;
#endif

}  // namespace orbwatch::remap
