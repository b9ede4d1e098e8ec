// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "app/pipeline/views/picture_use.h"
#include "app/pipeline/worker_pool.h"
#include "hal/camera.h"
#include "hal/sync/frame_set.h"
#include "proc/image/picture.h"
#include "proc/remap/remap.h"

namespace orbwatch::app::pipeline {

/// The pictures of one frame set with their mip levels, and sharpened to be shown: made once and
/// read by every view. The memory for all of it is allocated up front. Lower resolutions are not
/// sharpened.
/// Thread rule: build and extend on the pipeline's thread, which shares the work with the pool;
/// pictures is reentrant until the next of them.
class FramePyramids {
 public:
  /// `formats` by camera; by `uses` with every strength that a camera may be sharpened by.
  explicit FramePyramids(std::span<const hal::StreamFormat> formats, const PictureUses& uses = {});

  /// Replaces the pictures by those of `set`, whose frames must outlive their use, and makes what
  /// `uses` tells.
  void build(const hal::FrameSet& set, const PictureUses& uses, WorkerPool& workers);

  /// Makes what the set does not have yet of `uses`.
  void extend(const PictureUses& uses, WorkerPool& workers);

  /// A camera's picture, sharpened that much as far as this is used, and its first `levels` mip
  /// levels, or fewer where a picture is too small for more. Empty: the set has no frame of the
  /// camera. A format that is not sharpened, or a strength without memory: the picture as it is.
  std::span<const Picture> pictures(std::size_t camera, int levels, double sharpness = 0) const;

  /// Match that brings the camera's pictures to the exposure of another, for display; null: none.
  /// It outlives their use.
  void set_match(std::size_t camera, const remap::PhotometricTable* table) {
    matches_[camera] = table;
  }
  const remap::PhotometricTable* match(std::size_t camera) const { return matches_[camera]; }

 private:
  /// The camera's picture, sharpened that much.
  struct Sharpened {
    double sharpness;
    remap::SharpenedPicture picture;
    remap::SourceArea filled, wanted;
    std::array<Picture, remap::kMaxLevel + 1> levels;  ///< the sharpened one, then as the camera's
  };
  struct Camera {
    remap::Pyramid pyramid;
    std::vector<Sharpened> sharpened;
    bool has_picture = false;
    int filled = 0, wanted = 0;  ///< mip levels

    void set_source(const Picture& picture);
    /// Sets what is wanted beside what is filled; false: nothing.
    bool want(const PictureUse& use);
    /// The rows of a strip of the picture.
    void fill(int strip);
    void end_filling();
  };

  std::vector<Camera> cameras_;
  std::array<const remap::PhotometricTable*, hal::kMaxCameras> matches_{};  ///< by camera
};

}  // namespace orbwatch::app::pipeline
