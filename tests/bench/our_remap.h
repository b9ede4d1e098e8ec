#pragma once

#include "proc/remap/coordinate_grid.h"
#include "proc/remap/kernel.h"
#include "proc/remap/pyramid.h"
#include "tests/bench/frame.h"
#include "tests/bench/rig.h"

namespace orbwatch::bench {

/// The remap core on one thread, from a format to the same one; all that the bench knows of its
/// interface. `source` outlives it.
class OurRemap {
 public:
  OurRemap(const Rig& rig, const Frame& source,
           const remap::Kernel& kernel = remap::default_kernel());

  /// All that a new frame costs: also the halves of the source, where the grid asks for them.
  void run();
  const Frame& output() const { return output_; }

  /// Whether the view is smaller than its source around (x, y), so that a pixel there is a mean
  /// over several of the source.
  bool minifies(int x, int y) const {
    return grid_.tile(x / remap::kTile, y / remap::kTile).level > 0;
  }

 private:
  remap::CoordinateGrid grid_;
  remap::Pyramid pyramid_;
  const remap::Kernel& kernel_;
  Frame output_;
};

}  // namespace orbwatch::bench
