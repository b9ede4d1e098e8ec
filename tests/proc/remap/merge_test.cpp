#include "proc/remap/merge.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <vector>

#include "proc/image/validity.h"

namespace orbwatch::remap {
namespace {

TEST(MergeWeights, SharesAreWholeAndInProportion) {
  const std::array weights{1.0, 3.0, 0.0, 2.0};
  const MergeWeights merge(weights);
  for (std::size_t mask = 0; mask < 16; ++mask) {
    const auto& shares = merge.shares(mask);
    const int sum = std::accumulate(shares.begin(), shares.end(), 0);
    EXPECT_EQ(sum, (mask & 0b1011) ? 256 : 0) << mask;
    for (std::size_t n = 0; n < 4; ++n) {
      if (!(mask >> n & 1)) {
        EXPECT_EQ(shares[n], 0) << mask;
      }
    }
  }
  EXPECT_EQ(merge.shares(0b0011)[0], 64);
  EXPECT_EQ(merge.shares(0b0011)[1], 192);
  EXPECT_EQ(merge.shares(0b0001)[0], 256) << "alone it counts whole";
}

class Merge : public testing::Test {
 protected:
  static constexpr int kWidth = 37, kHeight = 21;
  std::vector<std::uint8_t> noise(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<std::uint8_t> pixels(kWidth * kHeight * 3);
    for (auto& p : pixels) p = static_cast<std::uint8_t>(random());
    return pixels;
  }
  template <class T>
  static ImageView<T> view(T* data, int channels) {
    return {data, kWidth, kHeight, channels, kWidth * channels};
  }
};

TEST_F(Merge, BlendsWhereSeveralSeeAndFillsWhereOneIsBlind) {
  const auto a = noise(1), b = noise(2), c = noise(3);
  std::vector<std::uint8_t> coverage(kWidth * kHeight);
  std::mt19937 random(4);
  for (auto& mask : coverage) mask = random() % 8;
  std::vector<std::uint8_t> out(a.size(), 99), validity(coverage.size(), 1);
  const std::array weights{0.5, 0.25, 1.0};
  const std::array sources{view(a.data(), 3), view(b.data(), 3), view(c.data(), 3)};
  merge(sources, view<const std::uint8_t>(coverage.data(), 1), MergeWeights(weights),
        view(out.data(), 3), view(validity.data(), 1), {0, 2});
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    const int mask = coverage[i];
    const double total = (mask & 1) * 0.5 + (mask >> 1 & 1) * 0.25 + (mask >> 2 & 1) * 1.0;
    EXPECT_EQ(validity[i], static_cast<int>(mask ? Validity::Seen : Validity::Blind));
    for (int k = 0; k < 3; ++k) {
      const std::size_t s = 3 * i + k;
      const double mean =
          (mask & 1) * 0.5 * a[s] + (mask >> 1 & 1) * 0.25 * b[s] + (mask >> 2 & 1) * 1.0 * c[s];
      EXPECT_NEAR(out[s], total > 0 ? mean / total : 0, 1.0);
    }
  }
}

TEST_F(Merge, ASingleSourcePassesUnchanged) {
  const auto a = noise(5);
  const std::vector<std::uint8_t> coverage(kWidth * kHeight, 1);
  std::vector<std::uint8_t> out(a.size()), validity(coverage.size());
  merge(std::array{view(a.data(), 3)}, view(coverage.data(), 1), MergeWeights(std::array{0.3}),
        view(out.data(), 3), view(validity.data(), 1), {0, 2});
  EXPECT_EQ(out, a);
}

}  // namespace
}  // namespace orbwatch::remap
