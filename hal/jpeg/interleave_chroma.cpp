#include "hal/jpeg/interleave_chroma.h"

#include <algorithm>

namespace orbwatch::hal {
namespace {

constexpr std::uint8_t kNeutral = 128;

/// One row of pairs out of rows of one plane, where a pair has columns x rows samples.
template <int columns>
void write_row(const std::uint8_t* upper, const std::uint8_t* lower, int count,
               std::uint8_t* pairs) {
  for (int x = 0; x < count; ++x) {
    unsigned sum = 0;
    for (int i = 0; i < columns; ++i)
      sum += unsigned{upper[columns * x + i]} + lower[columns * x + i];
    pairs[2 * x] = static_cast<std::uint8_t>((sum + columns) / (2 * columns));
  }
}

/// The same where two pairs share a sample.
void write_shared_row(const std::uint8_t* upper, const std::uint8_t* lower, int count,
                      std::uint8_t* pairs) {
  for (int x = 0; x < count; ++x) {
    pairs[2 * x] = static_cast<std::uint8_t>((unsigned{upper[x / 2]} + lower[x / 2] + 1) / 2);
  }
}

/// Every other sample of the pairs, from their first on.
void write_plane(const ImageView<const std::uint8_t>& plane, const ImageView<std::uint8_t>& pairs) {
  const int rows = plane.height / pairs.height;
  for (int y = 0; y < pairs.height; ++y) {
    // Of planes with as many rows, the mean is of a row and itself.
    const std::uint8_t* const upper = plane.row(rows * y);
    const std::uint8_t* const lower = plane.row(rows * y + rows - 1);
    if (plane.width == pairs.width) {
      write_row<1>(upper, lower, pairs.width, pairs.row(y));
    } else if (plane.width > pairs.width) {
      write_row<2>(upper, lower, pairs.width, pairs.row(y));
    } else {
      write_shared_row(upper, lower, pairs.width, pairs.row(y));
    }
  }
}

}  // namespace

void interleave_chroma(const ImageView<const std::uint8_t>& u,
                       const ImageView<const std::uint8_t>& v,
                       const ImageView<std::uint8_t>& pairs) {
  if (u.width == 0 || v.width == 0) {
    for (int y = 0; y < pairs.height; ++y) {
      std::fill_n(pairs.row(y), 2 * pairs.width, kNeutral);
    }
    return;
  }
  ImageView<std::uint8_t> second = pairs;
  ++second.data;
  write_plane(u, pairs);
  write_plane(v, second);
}

}  // namespace orbwatch::hal
