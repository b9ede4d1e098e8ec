#pragma once

#include "proc/remap/kernel.h"

namespace orbwatch::remap {

extern const Kernel kScalarKernel;

}  // namespace orbwatch::remap
