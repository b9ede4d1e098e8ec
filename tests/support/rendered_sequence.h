// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "proc/optics/ball_projection.h"
#include "proc/signals/region.h"

namespace orbwatch::tests {

/// One of the reference sequences of the process, with scene.json's data on each frame. Throws when
/// that is missing or broken.
class RenderedSequence {
 public:
  explicit RenderedSequence(const std::string& name);

  struct Spark {
    int id = 0;
    optics::Vec3 position;  ///< mm
    double radius = 0;      ///< mm
    double celsius = 0;
  };
  struct Frame {
    std::filesystem::path picture;
    optics::Vec3 melt;  ///< mm, the pool's centre
    std::vector<Spark> sparks;
  };

  const std::vector<Frame>& frames() const { return frames_; }
  double frame_rate() const { return frame_rate_; }
  /// Ball, walls, table and workpiece.
  const signals::RegionScene& scene() const { return scene_; }
  const optics::BallProjection& camera() const { return camera_.front(); }

 private:
  double frame_rate_ = 0;
  signals::RegionScene scene_;
  std::vector<optics::BallProjection> camera_;  ///< exactly one
  std::vector<Frame> frames_;
};

}  // namespace orbwatch::tests
