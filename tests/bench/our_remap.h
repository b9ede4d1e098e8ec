// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/image/picture.h"
#include "proc/remap/remap.h"
#include "tests/bench/frame.h"
#include "tests/bench/rig.h"

namespace orbwatch::bench {

/// The remap core on one thread, from a format to the same one; the bench uses no other interface
/// of it. `source` outlives it.
class OurRemap {
 public:
  OurRemap(const Rig& rig, const Frame& source,
           const remap::Kernel& kernel = remap::default_kernel());

  /// Remaps with one sample per pixel, like the peers.
  void run();
  const Frame& output() const { return output_; }

 private:
  remap::CoordinateGrid grid_;
  Picture source_;
  const remap::Kernel& kernel_;
  Frame output_;
};

}  // namespace orbwatch::bench
