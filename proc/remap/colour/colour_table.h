#pragma once

/// A table of 256 colours that runs of pixels are looked up in: `ColourTable` and `GreyTable`.
/// `colour_table_neon.h` where a table fits the processor's registers, else `colour_table_any.h`.
/// Both give the same.
#ifdef __aarch64__
#include "proc/remap/colour/colour_table_neon.h"
#else
#include "proc/remap/colour/colour_table_any.h"
#endif
