#pragma once

#include "proc/remap/kernel.h"

namespace orbwatch::remap {

/// Only for machines with AVX2.
extern const Kernel kAvx2Kernel;

}  // namespace orbwatch::remap
