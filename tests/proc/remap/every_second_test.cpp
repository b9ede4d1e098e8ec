#include "proc/remap/every_second.h"

#include <gtest/gtest.h>

#include <vector>

#include "proc/remap/coordinate.h"

namespace orbwatch::remap {
namespace {

TEST(EverySecond, ColumnIsCopiedWholeAndNothingElse) {
  constexpr int kRows = 7;
  constexpr std::uint8_t kUntouched = 255;
  for (int pixel = 1; pixel <= 4; ++pixel) {
    const std::ptrdiff_t fine_stride = kTile * pixel + 5, stride = kTile / 2 * pixel + 3;
    std::vector<std::uint8_t> fine(kRows * fine_stride), out(kRows * stride, kUntouched);
    for (std::size_t i = 0; i < fine.size(); ++i) fine[i] = static_cast<std::uint8_t>(i % 251);
    take_every_second_column({fine.data(), fine_stride, kTile, kRows}, pixel,
                             {out.data(), stride, kTile / 2, kRows});
    for (int y = 0; y < kRows; ++y) {
      for (int byte = 0; byte < stride; ++byte) {
        const int x = byte / pixel;
        const bool inside = x < kTile / 2;
        const auto from = static_cast<std::size_t>(y * fine_stride + 2 * x * pixel + byte % pixel);
        ASSERT_EQ(out[static_cast<std::size_t>(y * stride + byte)],
                  inside ? fine[from] : kUntouched)
            << pixel << " bytes, row " << y << ", byte " << byte;
      }
    }
  }
}

TEST(EverySecond, RowIsCopiedWholeAndNothingElse) {
  constexpr int kRows = 5;
  constexpr std::uint8_t kUntouched = 255;
  for (int bytes = 8; bytes <= 64; bytes += 8) {
    const std::ptrdiff_t fine_stride = bytes + 5, stride = bytes + 3;
    std::vector<std::uint8_t> fine(2 * kRows * fine_stride), out(kRows * stride, kUntouched);
    for (std::size_t i = 0; i < fine.size(); ++i) fine[i] = static_cast<std::uint8_t>(i % 251);
    take_every_second_row({fine.data(), fine_stride, kTile, 2 * kRows}, bytes,
                          {out.data(), stride, kTile, kRows});
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < stride; ++x) {
        const auto from = static_cast<std::size_t>(2 * y * fine_stride + x);
        ASSERT_EQ(out[static_cast<std::size_t>(y * stride + x)],
                  x < bytes ? fine[from] : kUntouched);
      }
    }
  }
}

}  // namespace
}  // namespace orbwatch::remap
