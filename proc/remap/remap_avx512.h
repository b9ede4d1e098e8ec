#pragma once

#include "proc/remap/kernel.h"

namespace orbwatch::remap {

/// Only for machines with AVX-512 F, BW, VL and VBMI.
extern const Kernel kAvx512Kernel;

}  // namespace orbwatch::remap
