#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "proc/align/drift/consensus.h"
#include "proc/align/drift/patch_window.h"
#include "proc/align/drift/reference_scale.h"
#include "proc/align/drift/shift_search.h"

namespace orbwatch::align {

/// Finds the ball of a reference picture in others. Not reentrant: it keeps buffers and where the
/// ball was last.
class BallTracker {
 public:
  /// Frames between searches of the whole picture for a ball that is not where it was.
  static constexpr int kSearchEvery = 30;

  /// The scale at which a ball is looked at: pixels of the picture per pixel there.
  static int scale_for(const optics::Outline& outline);

  /// `reference`: smoothed, at that scale; from `saturated` on it says nothing. `outline` in the
  /// picture's pixels.
  BallTracker(const cv::Mat& reference, const optics::Outline& outline, float saturated);

  /// False: the reference is of no use.
  bool has_texture() const;

  /// How the ball moved since the reference, px of the picture; nullopt when it does not show, with
  /// the reason().
  std::optional<PictureMotion> find(const Picture& picture);

  /// Static text for an operator.
  std::string_view reason() const { return reason_; }

  /// The share of the ball's motion that its surroundings went with it, from 0 (the ball moved) to
  /// 1 (the camera turned); nullopt when they show too little.
  std::optional<double> share_of_surroundings(const Picture& picture, const PictureMotion& ball);

 private:
  ReadWindow reading(const Picture& picture);
  Consensus at(const Picture& picture, const PictureMotion& guess);
  std::optional<PictureMotion> search(const Picture& picture);
  PictureMotion coarse_motion(const std::vector<cv::Mat>& pyramid, float saturated);

  int scale_;                           ///< pixels of the picture per pixel of the finest scale
  std::vector<ReferenceScale> scales_;  ///< the finest first, each half of the one before
  std::vector<ShiftSearch> search_;     ///< one, at the coarsest
  WindowReader reader_;
  Sighting sighting_;
  PictureMotion last_;  ///< at the finest scale
  int until_search_ = 0;
  std::string_view reason_;
};

}  // namespace orbwatch::align
