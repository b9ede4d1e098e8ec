// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "proc/image/pixel_format.h"

namespace orbwatch::app {

/// The forms in which readers need a view's picture.
struct PictureNeeds {
  bool rgb = false;
  bool bgr = false;
  bool grey = false;
  bool jpeg = false;
  bool counts = false;  ///< temperature counts beside the picture: see View::counts

  constexpr PictureNeeds& operator|=(const PictureNeeds& other) {
    rgb = rgb || other.rgb;
    bgr = bgr || other.bgr;
    grey = grey || other.grey;
    jpeg = jpeg || other.jpeg;
    counts = counts || other.counts;
    return *this;
  }
};

/// The need of a reader of pictures of one encoding: Rgb, Bgr or Grey.
constexpr PictureNeeds need_of(PixelFormat encoding) {
  return {encoding == PixelFormat::Rgb, encoding == PixelFormat::Bgr, encoding == PixelFormat::Grey,
          false, false};
}

/// The cheapest format that serves all needs for a picture of this size: JPEG compresses I420,
/// whose first plane is the grey picture. Nullopt: no reader needs it.
constexpr std::optional<PixelFormat> format_for(const PictureNeeds& needs, int width, int height) {
  const bool is_even = width % 2 == 0 && height % 2 == 0;
  if (needs.rgb || (needs.jpeg && !needs.bgr && !is_even)) return PixelFormat::Rgb;
  if (needs.bgr) return PixelFormat::Bgr;
  if (needs.jpeg) return PixelFormat::I420;
  if (needs.grey) return PixelFormat::Grey;
  return std::nullopt;
}

}  // namespace orbwatch::app
