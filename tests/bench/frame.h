// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "proc/image/picture.h"

namespace orbwatch::bench {

/// Samples in memory. Rows are an odd number of cache lines apart, so that they do not map to the
/// same cache sets.
struct Plane {
  /// A plane with `samples` of `sample_bytes` per pixel, all zero.
  static Plane blank(int width, int height, int samples, int sample_bytes);

  /// Fills it with white noise, the same for the same seed.
  void fill_with_noise(unsigned seed);

  /// Fills it with waves of 60 pixels, different for each seed: smooth, so that the order of
  /// sampling and conversion hardly matters.
  void fill_with_waves(unsigned seed);

  /// Sample `k` of pixel (x, y).
  int sample(int x, int y, int k) const;

  int width;
  int height;
  int samples;
  int sample_bytes;
  std::ptrdiff_t stride;  ///< bytes
  std::vector<std::byte> bytes;
};

/// A picture that owns its planes.
struct Frame {
  /// A frame of zeros.
  static Frame blank(PixelFormat format, int width, int height);

  void fill_with_noise(unsigned seed);
  void fill_with_waves(unsigned seed);
  MutablePicture picture();
  Picture picture() const;

  PixelFormat format;
  int width;
  int height;
  std::vector<Plane> planes;
};

}  // namespace orbwatch::bench
