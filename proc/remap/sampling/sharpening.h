// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace orbwatch::remap {

/// Unsharp masking: a sample plus `sharpness` times its difference to the mean around it, by a
/// Gauss filter of 3x3 pixels with the weights 4, 11, 4 along each axis (standard deviation 0.70
/// pixels).
///
/// In whole numbers, which is the specification of every implementation:
///     difference = 60 sample - 11 (the four beside it) - 4 (the four at its corners)
///                = (4 + 11 + 4)^2 / 4 (sample - mean)
///     gain       = sharpness 2^18 4 / 19^2, rounded to nearest
///     sharpened  = sample + floor((floor(difference gain / 2^15) + 4) / 2^3), clipped to 0..255
constexpr std::int16_t sharpening_gain(double sharpness) {
  const auto twice = static_cast<int>(sharpness * (2 << 18) * 4 / (19 * 19));
  return static_cast<std::int16_t>((twice + 1) / 2);
}

/// Largest sharpness; 0 is none.
inline constexpr double kMaxSharpness = 2;
static_assert(sharpening_gain(kMaxSharpness) == 5809);

/// Gains of the even and of the odd samples of a row: 0 keeps a sample unchanged.
using SharpeningGains = std::array<std::int16_t, 2>;

/// A row of a plane of 8 bit samples, and those above and below it. At the picture's border the row
/// itself replaces the missing one, and the outermost pixels replace missing neighbours.
struct RowsAround {
  const std::uint8_t* above;
  const std::uint8_t* row;
  const std::uint8_t* below;
  int samples;        ///< samples of each row; even if the gains differ
  int pixel_samples;  ///< distance from a sample to the same one in the next pixel
};

/// Writes the samples [first, last) of the sharpened row to their places in `out`, which shares no
/// memory with `rows`. Reads no other samples than theirs. Reentrant.
void sharpen_row(const RowsAround& rows, const SharpeningGains& gains, int first, int last,
                 std::uint8_t* out);

}  // namespace orbwatch::remap
