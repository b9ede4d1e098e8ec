// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/kernel/kernel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>
#include <span>
#include <vector>

#include "proc/remap/kernel/bilinear.h"
#include "tests/proc/remap/kernel/random_patch.h"
#include "tests/support/guarded_memory.h"

namespace orbwatch::remap {
namespace {

using tests::GuardedMemory;
using tests::RandomPatch;

struct NamedLayout {
  Layout layout;
  const char* name;
};
void PrintTo(const NamedLayout& layout, std::ostream* out) { *out << layout.name; }
constexpr std::array<NamedLayout, kKernelLayouts> kNamedLayouts{{
    {Layout::One8, "One8"},
    {Layout::Two8, "Two8"},
    {Layout::Three8, "Three8"},
    {Layout::Four8, "Four8"},
    {Layout::FirstOfTwo8, "FirstOfTwo8"},
    {Layout::OddOfFour8, "OddOfFour8"},
    {Layout::One16, "One16"},
}};

/// The area of a map's windows, source pixels.
struct Extent {
  std::int64_t left = std::numeric_limits<std::int64_t>::max(), top = left;
  std::int64_t right = std::numeric_limits<std::int64_t>::min(), bottom = right;

  explicit Extent(const BlockMap& map) {
    const WindowWalk& w = map.windows;
    for (std::int64_t y = 0; y < map.blocks_y; ++y) {
      for (std::int64_t x = 0; x < map.blocks_x; ++x) {
        const auto window = [&](int axis) {
          return (w.value[axis] + x * w.step_x[axis] + y * w.step_y[axis] + x * y * w.xy[axis] +
                  x * (x - 1) / 2 * w.xx[axis] + y * (y - 1) / 2 * w.yy[axis]) >>
                 32;
        };
        const std::int64_t u = window(0), v = window(1);
        left = std::min(left, u);
        right = std::max(right, u + kWindow);
        top = std::min(top, v);
        bottom = std::max(bottom, v + kWindow);
      }
    }
  }
};

/// The same patch shifted to the left and up.
Patch shifted(const Patch& patch, std::int64_t left, std::int64_t up) {
  constexpr int kPixelBits = kFractionBits + PatchRow::kScaleBits;
  Quadratic u = patch.u(), v = patch.v();
  u.value -= left << kPixelBits;
  v.value -= up << kPixelBits;
  return {u, v};
}

/// A job whose source is exactly as large as its windows need, and the pixels around its output.
class Trial {
 public:
  Trial(std::mt19937& random, Layout layout, const Patch& patch, int blocks_x, int blocks_y)
      : layout_(layout),
        columns_(blocks_x * kBlock),
        rows_(blocks_y * kBlock),
        bytes_across_(columns_ * info(layout).out_bytes()) {
    const auto any = [&random](int count) { return static_cast<int>(random() % count); };
    const Uv64 rounding = BlockMap::rounding(added_u(layout), added_v(layout));
    BlockMap anywhere;
    if (!anywhere.fit(patch, columns_, rows_, rounding)) return;
    const Extent extent(anywhere);
    fits_ = map_.fit(shifted(patch, extent.left, extent.top), columns_, rows_, rounding);
    if (!fits_) return;

    const auto width = static_cast<int>(extent.right - extent.left) * info(layout).pixel_bytes;
    const auto height = static_cast<int>(extent.bottom - extent.top);
    source_stride_ = width + any(40);
    const std::size_t bytes = (height - 1) * source_stride_ + width;
    source_ = any(2) ? memory_.first(bytes) : memory_.last(bytes);
    const bool extreme = any(2) == 1;
    for (std::uint8_t& sample : source_) {
      const std::uint8_t value = static_cast<std::uint8_t>(random());
      sample = extreme ? (value & 1 ? 255 : 0) : value;
    }
    margin_ = 64 + any(64);
    out_stride_ = bytes_across_ + any(80);
  }

  /// False if the patch is too steep.
  bool fits() const { return fits_; }

  std::vector<std::uint8_t> out_of(const Kernel& kernel) const {
    return out_of(kernel.tiles[static_cast<std::size_t>(layout_)]);
  }
  std::vector<std::uint8_t> out_of(Kernel::Tile tile) const {
    std::vector<std::uint8_t> out(2 * margin_ + rows_ * out_stride_, kCanary);
    tile({map_,
          {source_.data(), source_stride_, 0, 0},
          {out.data() + margin_, out_stride_, columns_, rows_}});
    return out;
  }

  /// The pixels of `out`, of which every `step_x`-th and `step_y`-th are kept.
  std::vector<std::uint8_t> kept(const std::vector<std::uint8_t>& out, int step_x,
                                 int step_y) const {
    std::vector<std::uint8_t> kept(out.size(), kCanary);
    const std::ptrdiff_t pixel = info(layout_).out_bytes();
    for (int y = 0; y < rows_; y += step_y) {
      for (int x = 0; x < columns_; x += step_x) {
        std::copy_n(out.begin() + margin_ + y * out_stride_ + x * pixel, pixel,
                    kept.begin() + margin_ + y / step_y * out_stride_ + x / step_x * pixel);
      }
    }
    return kept;
  }

  /// The means of `step_x` x `step_y` pixels of `out`, of 8 bit samples.
  std::vector<std::uint8_t> means(const std::vector<std::uint8_t>& out, int step_x,
                                  int step_y) const {
    std::vector<std::uint8_t> means(out.size(), kCanary);
    const int samples = info(layout_).samples, count = step_x * step_y;
    for (int y = 0; y < rows_ / step_y; ++y) {
      for (int x = 0; x < columns_ / step_x * samples; ++x) {
        const int left = x / samples * step_x * samples + x % samples;
        int sum = 0;
        for (int k = 0; k < count; ++k) {
          sum +=
              out[margin_ + (y * step_y + k / step_x) * out_stride_ + left + k % step_x * samples];
        }
        means[margin_ + y * out_stride_ + x] = static_cast<std::uint8_t>((sum + count / 2) / count);
      }
    }
    return means;
  }

  void expect_canaries(const std::vector<std::uint8_t>& out) const {
    for (std::size_t k = 0; k < out.size(); ++k) {
      const auto at = static_cast<std::ptrdiff_t>(k) - margin_;
      const bool inside = at >= 0 && at < rows_ * out_stride_ && at % out_stride_ < bytes_across_;
      if (!inside) {
        ASSERT_EQ(out[k], kCanary) << at;
      }
    }
  }

 private:
  static constexpr std::uint8_t kCanary = 0xa5;
  // The windows of 4x8 blocks that are two source pixels per pixel apart, four bytes each.
  static inline GuardedMemory memory_{128 * (4 * 128 + 64)};

  Layout layout_;
  int columns_, rows_;
  std::ptrdiff_t bytes_across_;
  BlockMap map_;
  bool fits_ = false;
  std::span<std::uint8_t> source_;
  std::ptrdiff_t source_stride_ = 0, out_stride_ = 0, margin_ = 0;
};

/// The steepest patch of a shape for one of the parts of windows that kernels treat differently.
Patch steepest_of(const RandomPatch& shape, int blocks_x, int blocks_y, int part) {
  return shape.steepest(blocks_x, blocks_y, part % 2 ? 5 : kWindow, part / 2 % 2 ? 6 : kWindow);
}

class KernelOfLayout : public testing::TestWithParam<NamedLayout> {};

TEST_P(KernelOfLayout, EqualsTheScalarOne) {
  std::mt19937 random(5);
  int steepest = 0, gentle = 0;
  for (int round = 0; round < 2000; ++round) {
    const int blocks_x = 1 << (round % 3), blocks_y = 1 << (round / 2 % 4);
    const bool at_limit = round % 4 == 0;
    const RandomPatch shape(random, {round % 5 ? 1.0 : 0.3, round % 7 ? 0.01 : 0});
    const Trial trial(random, GetParam().layout,
                      at_limit ? steepest_of(shape, blocks_x, blocks_y, round / 4) : shape.patch(),
                      blocks_x, blocks_y);
    if (!trial.fits()) continue;
    ++(at_limit ? steepest : gentle);
    const std::vector<std::uint8_t> expected = trial.out_of(scalar_kernel());
    trial.expect_canaries(expected);
    for (const Kernel* kernel : kernels()) {
      ASSERT_EQ(trial.out_of(*kernel), expected) << kernel->name << " in round " << round;
    }
  }
  EXPECT_GT(steepest, 400);
  EXPECT_GT(gentle, 500);
}

TEST_P(KernelOfLayout, AveragesPairsAndSquares) {
  std::mt19937 random(9);
  int fitting = 0;
  for (int round = 0; round < 500; ++round) {
    const int blocks_y = 1 << (round / 2 % 4);
    const RandomPatch shape(random, {round % 5 ? 1.0 : 0.3, round % 7 ? 0.01 : 0});
    const Trial trial(random, GetParam().layout,
                      round % 3 ? shape.patch() : shape.steepest(4, blocks_y), 4, blocks_y);
    if (!trial.fits()) continue;
    ++fitting;
    const std::vector<std::uint8_t> all = trial.out_of(scalar_kernel());
    const auto expect_means = [&](Kernel::Tile kernel, int step_x, int step_y) {
      if (kernel == nullptr) return;
      ASSERT_EQ(trial.out_of(kernel), trial.means(all, step_x, step_y))
          << step_x << 'x' << step_y << " in round " << round;
    };
    for (const Kernel* kernel : kernels()) {
      const auto number = static_cast<std::size_t>(GetParam().layout);
      expect_means(kernel->means_along_x[number], 2, 1);
      expect_means(kernel->means_along_y[number], 1, 2);
      expect_means(kernel->means_of_four[number], 2, 2);
    }
  }
  EXPECT_GT(fitting, 200);
}

TEST_P(KernelOfLayout, KeepsEverySecondColumnOrRow) {
  std::mt19937 random(7);
  int fitting = 0;
  for (int round = 0; round < 500; ++round) {
    const int blocks_x = round % 2 ? 4 : 2, blocks_y = 2 << (round / 2 % 3);
    const RandomPatch shape(random, {round % 5 ? 1.0 : 0.3, round % 7 ? 0.01 : 0});
    const Trial trial(random, GetParam().layout,
                      round % 3 ? shape.patch() : steepest_of(shape, blocks_x, blocks_y, round / 6),
                      blocks_x, blocks_y);
    if (!trial.fits()) continue;
    ++fitting;
    const std::vector<std::uint8_t> all = trial.out_of(scalar_kernel());
    for (const Kernel* kernel : kernels()) {
      const auto number = static_cast<std::size_t>(GetParam().layout);
      if (kernel->even_columns[number]) {
        ASSERT_EQ(trial.out_of(kernel->even_columns[number]), trial.kept(all, 2, 1)) << round;
      }
      if (kernel->even_rows[number]) {
        ASSERT_EQ(trial.out_of(kernel->even_rows[number]), trial.kept(all, 1, 2)) << round;
      }
    }
  }
  EXPECT_GT(fitting, 200);
}

INSTANTIATE_TEST_SUITE_P(All, KernelOfLayout, testing::ValuesIn(kNamedLayouts),
                         [](const auto& tested) { return tested.param.name; });

double mixed(double a, double b, double share) { return a + (b - a) * share; }

/// Compares with bilinear interpolation in double precision between the samples around the patch's
/// places, in units of 8 bit.
template <class Sample>
void expect_bilinear(Layout layout) {
  constexpr int kSize = 64;
  constexpr double kUnit = std::numeric_limits<Sample>::max() / 255.0;
  std::mt19937 random(6);
  std::vector<Sample> source(kSize * kSize);
  double squares = 0, worst = 0;
  int count = 0;
  for (int round = 0; round < 300; ++round) {
    for (Sample& sample : source) sample = static_cast<Sample>(random());
    const Patch anywhere = RandomPatch(random, {0.8, 0.004}).patch();
    const Coordinate middle = anywhere.at(8, 8);
    const Patch patch = shifted(anywhere, (middle.u >> kFractionBits) - kSize / 2,
                                (middle.v >> kFractionBits) - kSize / 2);
    BlockMap map;
    if (!map.fit(patch, kTile, kTile, BlockMap::rounding(added_u(layout), added_v(layout))))
      continue;
    std::array<Sample, kTile * kTile> out;
    const SourcePlane plane{reinterpret_cast<const std::uint8_t*>(source.data()),
                            kSize * sizeof(Sample), kSize, kSize};
    const TargetPlane target{reinterpret_cast<std::uint8_t*>(out.data()), kTile * sizeof(Sample),
                             kTile, kTile};
    scalar_kernel().sample_tile(layout, {map, plane, target});
    const auto exact = [](const Quadratic& q, double x, double y) {
      return (q.value + x * q.x + y * q.y + x * y * q.xy + x * x * q.xx + y * y * q.yy) / (1 << 24);
    };
    for (int y = 0; y < kTile; ++y) {
      for (int x = 0; x < kTile; ++x) {
        const double u = exact(patch.u(), x, y), v = exact(patch.v(), x, y);
        const auto left = static_cast<int>(std::floor(u)), top = static_cast<int>(std::floor(v));
        const Sample* const corner = &source[top * kSize + left];
        const double expected = mixed(mixed(corner[0], corner[1], u - left),
                                      mixed(corner[kSize], corner[kSize + 1], u - left), v - top);
        const double error = (out[y * kTile + x] - expected) / kUnit;
        squares += error * error;
        worst = std::max(worst, std::abs(error));
        ++count;
      }
    }
  }
  ASSERT_GT(count, 20000);
  EXPECT_LT(std::sqrt(squares / count), 1.0);
  EXPECT_LT(worst, 5.0);
}

TEST(ScalarKernel, InterpolatesWhiteNoiseLikeDoublePrecision) {
  expect_bilinear<std::uint8_t>(Layout::One8);
  expect_bilinear<std::uint16_t>(Layout::One16);
}

TEST(Kernels, AreFoundByName) {
  ASSERT_FALSE(kernels().empty());
  EXPECT_EQ(kernels().front(), &scalar_kernel());
  for (const Kernel* kernel : kernels()) {
    const auto found = find_kernel(kernel->name);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(*found, kernel);
  }
}

TEST(Kernels, SayWhyThereIsNone) {
  for (const char* name : {"", "avx", "SCALAR", "scalar "}) {
    const auto found = find_kernel(name);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().message,
              "remap kernel '" + std::string(name) + "' is none of scalar, neon, avx2, avx512");
  }
#if defined(__aarch64__)
  const char* const elsewhere = "avx2";
#else
  const char* const elsewhere = "neon";
#endif
  const auto found = find_kernel(elsewhere);
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().message,
              testing::StartsWith("this machine cannot run the remap kernel '" +
                                  std::string(elsewhere) + "', only scalar"));
}

// CMakeLists.txt also runs this test with ORBWATCH_ISA set.
TEST(Kernels, DefaultIsWhatTheEnvironmentAsksForOrTheFastest) {
  const char* const asked = std::getenv("ORBWATCH_ISA");
  const Kernel* expected = kernels().back();
  for (const Kernel* kernel : kernels()) {
    if (asked && kernel->name == asked) expected = kernel;
  }
  EXPECT_EQ(default_kernel().name, expected->name);
  EXPECT_EQ(&default_kernel(), expected);
}

}  // namespace
}  // namespace orbwatch::remap
