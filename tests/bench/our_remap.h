#pragma once

#include "proc/image/picture.h"
#include "proc/remap/remap.h"
#include "tests/bench/frame.h"
#include "tests/bench/rig.h"

namespace orbwatch::bench {

/// The remap core on one thread, from a format to the same one; all that the bench knows of its
/// interface. `source` outlives it.
class OurRemap {
 public:
  OurRemap(const Rig& rig, const Frame& source,
           const remap::Kernel& kernel = remap::default_kernel());

  /// One sample per pixel, as the peers do it.
  void run();
  const Frame& output() const { return output_; }

 private:
  remap::CoordinateGrid grid_;
  Picture source_;
  const remap::Kernel& kernel_;
  Frame output_;
};

}  // namespace orbwatch::bench
