#include "tests/bench/our_remap.h"

#include "proc/remap/remap.h"

namespace orbwatch::bench {

OurRemap::OurRemap(const Rig& rig, const Frame& source, const remap::Kernel& kernel)
    : grid_(rig.view, rig.ball, rig.source, rig.source),
      pyramid_(source.format, source.width, source.height, grid_.halves()),
      kernel_(kernel),
      output_(Frame::blank(source.format, rig.named.width, rig.named.height)) {
  pyramid_.set_source(source.picture());
}

void OurRemap::run() {
  pyramid_.fill();
  remap::remap(grid_, pyramid_.pictures(), remap::Interpolation::Bilinear, output_.picture(),
               {0, grid_.tiles_y()}, kernel_);
}

}  // namespace orbwatch::bench
