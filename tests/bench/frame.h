#pragma once

#include <cstddef>
#include <vector>

#include "proc/image/picture.h"

namespace orbwatch::bench {

/// Samples in memory. Rows are an odd number of cache lines apart, so that they do not meet in the
/// same cache sets.
struct Plane {
  /// `samples` of `sample_bytes` per pixel, all zero.
  static Plane blank(int width, int height, int samples, int sample_bytes);

  /// White noise, the same for the same seed.
  void fill_with_noise(unsigned seed);

  /// Waves of 60 pixels, others for another seed: smooth, so that the order in which they are
  /// sampled and converted hardly matters.
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
  /// All zero.
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
