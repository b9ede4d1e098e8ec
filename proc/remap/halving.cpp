#include "proc/remap/halving.h"

#include <cstring>
#include <type_traits>

namespace orbwatch::remap {
namespace {

template <class Sample>
Sample read(const std::uint8_t* from) {
  Sample sample = 0;
  std::memcpy(&sample, from, sizeof sample);
  return sample;
}

/// One row of a half from two rows of the picture below.
template <Layout layout>
void halve_row(const std::uint8_t* upper, const std::uint8_t* lower, std::uint8_t* out, int width) {
  constexpr LayoutInfo kInfo = info(layout);
  using Sample = std::conditional_t<kInfo.sample_bytes == 1, std::uint8_t, std::uint16_t>;
  for (int x = 0; x < width; ++x) {
    for (int k = 0; k < kInfo.samples; ++k) {
      const int sample = (kInfo.first + k * kInfo.every) * kInfo.sample_bytes;
      const int left = 2 * x * kInfo.pixel_bytes + sample, right = left + kInfo.pixel_bytes;
      const unsigned sum = read<Sample>(upper + left) + read<Sample>(upper + right) +
                           read<Sample>(lower + left) + read<Sample>(lower + right);
      const auto mean = static_cast<Sample>((sum + 2) / 4);
      std::memcpy(out + x * kInfo.pixel_bytes + sample, &mean, sizeof mean);
    }
  }
}

constexpr std::array<HalveRow, kLayouts> kHalveRow{
    halve_row<Layout::One8>,  halve_row<Layout::Two8>,        halve_row<Layout::Three8>,
    halve_row<Layout::Four8>, halve_row<Layout::FirstOfTwo8>, halve_row<Layout::OddOfFour8>,
    halve_row<Layout::One16>, halve_row<Layout::Three16>};

}  // namespace

HalveRow halve_row(Layout layout) { return kHalveRow[static_cast<std::size_t>(layout)]; }

}  // namespace orbwatch::remap
