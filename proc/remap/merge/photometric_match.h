// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "proc/image/pixel_format.h"
#include "proc/remap/merge/merge.h"

namespace orbwatch::remap {

/// Transfer function from light to samples. Values are shares of full scale, 0..1.
enum class Transfer { Srgb, Linear };

/// The transfer function of a format's pictures: linear for 16-bit counts, sRGB for all others.
constexpr Transfer transfer_of(PixelFormat format) {
  return format == PixelFormat::Y16 ? Transfer::Linear : Transfer::Srgb;
}

/// Converts a sample to light. Source: IEC 61966-2-1.
inline double to_light(Transfer transfer, double sample) {
  if (transfer == Transfer::Linear) return sample;
  return sample <= 0.04045 ? sample / 12.92 : std::pow((sample + 0.055) / 1.055, 2.4);
}

/// Converts light to a sample, the inverse of to_light().
inline double from_light(Transfer transfer, double light) {
  if (transfer == Transfer::Linear) return light;
  return light <= 0.0031308 ? light * 12.92 : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

/// Matches a source to the first source's exposure, white balance and black level: per channel, in
/// light, matched = gain * light + offset.
struct PhotometricMatch {
  struct Channel {
    double gain = 1;
    double offset = 0;  ///< share of full scale
  };
  enum class Outcome {
    Reference,    ///< the first source, to which others are matched
    Matched,      ///< matched by its overlap with the others
    TooLittle,    ///< overlap too small, or without agreement: unchanged
    Implausible,  ///< gain beyond 1/16..16 or offset beyond 25 % of full scale: unchanged
  };
  std::array<Channel, 3> channels;
  Outcome outcome = Outcome::Reference;
};

/// Compares pictures of one view where two of them overlap and finds the gains and offsets that
/// make them agree: a robust line per pair and channel (fit_line) through the means of blocks of
/// 8x8 pixels, so that a sharper camera's finer detail does not count; then all sources together by
/// least squares. Blocks are weighted by the lesser of the two weights. Blocks with nearly black or
/// saturated samples are left out. One match per source, in their order. Reentrant.
template <class T>
std::vector<PhotometricMatch> match_photometry(std::span<const MergeSource<T>> sources,
                                               Transfer transfer);

/// A match of pictures of one format, ready to be applied. Immutable; reentrant.
class PhotometricTable {
 public:
  /// `format`: Grey, Y16, Rgb or Rgb16.
  PhotometricTable(const PhotometricMatch& match, PixelFormat format);

  /// Replaces every sample of a picture of the table's format. A table of Rgb also serves Bgr, and
  /// Grey by the mean of its channels with luma's weights. T is the format's sample type.
  template <class T>
  void apply(const ImageView<T>& picture, PixelFormat format) const;

 private:
  using Samples = std::vector<std::uint16_t>;
  std::array<Samples, 3> samples_;  ///< one entry per channel and sample
  Samples luma_;                    ///< one entry per sample; for Rgb
};

}  // namespace orbwatch::remap
