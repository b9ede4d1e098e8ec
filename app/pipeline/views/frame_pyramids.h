#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "app/pipeline/worker_pool.h"
#include "hal/camera.h"
#include "hal/sync/frame_set.h"
#include "proc/image/picture.h"
#include "proc/remap/remap.h"

namespace orbwatch::app {

/// How many mip levels of each camera's picture are sampled, by camera.
using MipLevelCounts = std::array<int, hal::kMaxCameras>;

/// The pictures of one frame set with their mip levels, built once and read by every view. The
/// memory for all levels is allocated up front.
/// Thread rule: build and extend on the pipeline's thread, which shares the work with the pool;
/// pictures is reentrant until the next of them.
class FramePyramids {
 public:
  /// `formats` by camera.
  explicit FramePyramids(std::span<const hal::StreamFormat> formats);

  /// Replaces the pictures by those of `set`, whose frames must outlive their use, and fills the
  /// first `counts` mip levels of each.
  void build(const hal::FrameSet& set, const MipLevelCounts& counts, WorkerPool& workers);

  /// Fills those of the first `counts` mip levels that the set does not have yet.
  void extend(const MipLevelCounts& counts, WorkerPool& workers);

  /// A camera's picture and its first `levels` mip levels, or fewer where a picture is too small
  /// for more. Empty: the set has no frame of the camera.
  std::span<const Picture> pictures(std::size_t camera, int levels) const;

 private:
  std::vector<remap::Pyramid> pyramids_;              ///< by camera
  std::array<bool, hal::kMaxCameras> has_picture_{};  ///< by camera
  MipLevelCounts filled_{};
};

}  // namespace orbwatch::app
