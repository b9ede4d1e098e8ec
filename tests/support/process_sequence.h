// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "proc/optics/vec.h"
#include "tests/support/mirror_room.h"

namespace orbwatch::tests {

/// A camera that watches a process in a ball for an hour: sparks fly, a tool moves in the ball and
/// in front of it, lamps and shadows come and go, the exposure changes, the machine vibrates, and
/// sometimes it is dark. A thermal camera's counts drift, and hot things appear. Ray-traced by
/// mirror_room(), nothing of the product's ball models is used.
struct ProcessSettings {
  std::uint64_t seed = 1;
  int width = 800;
  int height = 640;
  double radius = 300;
  double distance = 12;  ///< ball radii
  bool thermal = false;
};

class ProcessSequence {
 public:
  /// Seconds for which lamps, exposure, tool and vibration are constant.
  static constexpr double kSlot = 10;

  explicit ProcessSequence(const ProcessSettings& settings);

  /// Frame at a time: grey, 8 bit, or 16 bit for a thermal camera; the same for the same time;
  /// valid until the next. `turn`: the camera's about its centre since the beginning, a rotation
  /// vector in its frame, radians. A ray of the turned camera had the coordinates R^-1 ray before.
  const cv::Mat& frame(double seconds, const optics::Vec3& turn = {});

  /// Moves the camera slightly aside, so that the ball is at this place in its picture, shares of
  /// the half field: traces the room again.
  void shift_ball(const optics::Vec2& off_axis);

  bool is_dark(double seconds) const;

  const TrueLimb& limb() const { return limb_; }
  double focal_length() const { return focal_length_; }  ///< px; principal point in the middle
  const optics::Vec3& ball() const { return ball_; }     ///< camera frame, ball radii

 private:
  struct Slot;

  Slot slot(std::int64_t n) const;
  void trace(const optics::Vec2& off_axis);
  void light(std::int64_t n, const Slot& slot);
  cv::Matx33d warp(double seconds, const Slot& slot, const optics::Vec3& turn) const;
  void draw_tool(double seconds, const Slot& slot);
  void draw_sparks(double seconds, const Slot& slot);
  void add_noise(double seconds);

  ProcessSettings settings_;
  TrueLimb limb_;
  double focal_length_ = 0;
  optics::Vec3 ball_;
  cv::Mat room_;  ///< 32F, at twice the resolution, with a margin
  cv::Mat lit_;   ///< the same with the light of slot lit_slot_
  std::int64_t lit_slot_ = -1;
  cv::Mat seen_, noise_, frame_;
};

/// Error of view directions: rms angle, degrees, over the directions up to 150 degrees from the
/// camera, between the direction of a pixel for a camera that assumes its ball at `stored`, and the
/// truth: the ball is at `true_ball`, seen by a camera turned by `turn`. Computed by plain
/// reflection of vectors. Camera frame, ball radii.
double true_view_error(double focal_length, const optics::Vec3& stored,
                       const optics::Vec3& true_ball, const optics::Vec3& turn);

}  // namespace orbwatch::tests
