#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "proc/image/picture.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/photometric_match.h"
#include "proc/remap/remap.h"

namespace orbwatch::app {

/// A picture and where it shows the room on the ball.
struct ViewedPicture {
  Picture picture;
  optics::BallProjection ball;
};

/// A view as pictures show it. Owns its pixels; cannot be copied, since its picture points at them.
struct MergedView {
  MergedView(PixelFormat format, int width, int height);
  MergedView(MergedView&&) = default;
  MergedView& operator=(MergedView&&) = default;
  MergedView(const MergedView&) = delete;
  MergedView& operator=(const MergedView&) = delete;

  ImageView<std::uint8_t> validity();

  std::vector<std::byte> pixels;
  std::vector<std::uint8_t> seen;  ///< one Validity per pixel
  MutablePicture picture;          ///< of the pictures' own format
  /// How each picture was matched to the first; empty if that was not asked for.
  std::vector<remap::PhotometricMatch> matches;
};

/// Remaps 1 to remap::kMaxSources pictures of one format (Grey, Y16, Rgb, Rgb16) into a view,
/// brings them to the first one's exposure if `match`, and blends them by resolution.
MergedView merge_pictures(const optics::ViewProjection& view,
                          std::span<const ViewedPicture> pictures,
                          remap::Interpolation interpolation, bool match);

}  // namespace orbwatch::app
