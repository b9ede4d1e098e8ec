// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/colour/luma.h"

#include "proc/remap/colour/jfif_run.h"

namespace orbwatch::remap {

void luma(const std::uint8_t* rgb, std::uint8_t* grey, int pixels) {
  int x = 0;
  for (; x + kRun <= pixels; x += kRun) luma_run(rgb + 3 * x, grey + x);
  for (; x < pixels; ++x) grey[x] = luma(rgb + 3 * x);
}

}  // namespace orbwatch::remap
