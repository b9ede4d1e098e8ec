#include "proc/remap/oversampling.h"

#include <cstring>

namespace orbwatch::remap {
namespace {

template <class Sample>
void average_row(const std::uint8_t* upper, const std::uint8_t* lower, int samples, int columns,
                 std::uint8_t* out) {
  const auto at = [](const std::uint8_t* row, int n) {
    Sample sample = 0;
    std::memcpy(&sample, row + n * sizeof sample, sizeof sample);
    return unsigned{sample};
  };
  for (int x = 0; x < columns; ++x) {
    for (int k = 0; k < samples; ++k) {
      const int left = 2 * x * samples + k, right = left + samples;
      const unsigned sum = at(upper, left) + at(upper, right) + at(lower, left) + at(lower, right);
      const auto mean = static_cast<Sample>((sum + 2) / 4);
      std::memcpy(out + (x * samples + k) * sizeof mean, &mean, sizeof mean);
    }
  }
}

}  // namespace

void average(const OversampledTile& tile, Layout layout, const TargetPlane& out) {
  const std::ptrdiff_t stride = OversampledTile::stride(layout);
  const LayoutInfo& facts = info(layout);
  const auto row = facts.sample_bytes == 2 ? average_row<std::uint16_t> : average_row<std::uint8_t>;
  for (int y = 0; y < out.rows; ++y) {
    const std::uint8_t* upper = tile.samples.data() + 2 * y * stride;
    row(upper, upper + stride, facts.samples, out.columns, out.data + y * out.stride);
  }
}

}  // namespace orbwatch::remap
