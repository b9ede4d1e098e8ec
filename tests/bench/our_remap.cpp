// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/our_remap.h"

#include "proc/remap/remap.h"

namespace orbwatch::bench {

OurRemap::OurRemap(const Rig& rig, const Frame& source, const remap::Kernel& kernel)
    : grid_(rig.view, rig.ball, rig.source, rig.source),
      source_(source.picture()),
      kernel_(kernel),
      output_(Frame::blank(source.format, rig.named.width, rig.named.height)) {}

void OurRemap::run() {
  remap::remap(grid_, {&source_, 1}, remap::Interpolation::Bilinear, output_.picture(),
               {0, grid_.tiles_y()}, kernel_);
}

}  // namespace orbwatch::bench
