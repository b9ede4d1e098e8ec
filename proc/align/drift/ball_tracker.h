// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "proc/align/drift/consensus.h"
#include "proc/align/drift/patch_window.h"
#include "proc/align/drift/reference_scale.h"
#include "proc/align/drift/shift_search.h"

namespace orbwatch::align {

/// Finds the ball of a reference picture in others. Not reentrant: it keeps buffers and the ball's
/// last place.
class BallTracker {
 public:
  /// Frames between searches of the whole picture for a ball that is not at its place: it has left
  /// it, or the light is out.
  static constexpr int kSearchEvery = 30;

  /// The scale for a ball: pixels of the picture per pixel of the finest scale.
  static int scale_for(const optics::Outline& outline);

  /// `reference`: smoothed, at that scale; brightness from `saturated` on is not used. `outline` in
  /// the picture's pixels.
  BallTracker(const cv::Mat& reference, const optics::Outline& outline, float saturated);

  /// False: the reference cannot be used.
  bool has_texture() const;

  /// The ball's motion since the reference, px of the picture; nullopt when the ball is not found,
  /// with the reason().
  std::optional<PictureMotion> find(const Picture& picture);

  /// A cheap look at a few patches: the median of their distances from where `motion` puts them, px
  /// of the picture; nullopt when less than half of them are found.
  std::optional<double> distance_from(const Picture& picture, const PictureMotion& motion);

  /// Static text for an operator.
  std::string_view reason() const { return reason_; }

  /// The share of the ball's motion that its surroundings have in common with it, from 0 (the ball
  /// moved) to 1 (the camera turned); nullopt when too few of them are found.
  std::optional<double> share_of_surroundings(const Picture& picture, const PictureMotion& ball);

 private:
  ReadWindow reading(const Picture& picture);
  Consensus at(const Picture& picture, const PictureMotion& guess);
  std::optional<PictureMotion> search(const Picture& picture);
  /// The motion in px of the picture; the next frame begins there, and may search at once.
  PictureMotion continued(const PictureMotion& motion);
  PictureMotion coarse_motion(const std::vector<cv::Mat>& pyramid, float saturated);

  int scale_;                           ///< pixels of the picture per pixel of the finest scale
  std::vector<ReferenceScale> scales_;  ///< the finest first, each half of the one before
  PatchGroup glanced_;                  ///< some of the ball's, spread over it, at the finest
  std::vector<ShiftSearch> search_;     ///< one, at the coarsest
  WindowReader reader_;
  Sighting sighting_;
  std::vector<double> distances_;
  PictureMotion last_;     ///< at the finest scale
  int until_search_ = 0;   ///< frames
  bool was_dark_ = false;  ///< the whole picture that was searched last
  std::string_view reason_;
};

}  // namespace orbwatch::align
