// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/hot_spot/edges.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <utility>

#include "tests/support/guarded_memory.h"

namespace orbwatch::signals {
namespace {

using Runs = std::vector<std::pair<int, int>>;

constexpr int kWidest = 300;

/// A row of counts and their validity, next to unreadable memory at its begin or end.
template <class T>
struct GuardedRow {
  orbwatch::tests::GuardedMemory count_memory{kWidest * sizeof(T)}, validity_memory{kWidest};
  T* counts = nullptr;
  std::uint8_t* validity = nullptr;

  void place(int width, bool at_end) {
    const auto pixels = static_cast<std::size_t>(width), bytes = pixels * sizeof(T);
    const auto values = at_end ? count_memory.last(bytes) : count_memory.first(bytes);
    counts = reinterpret_cast<T*>(values.data());
    validity = (at_end ? validity_memory.last(pixels) : validity_memory.first(pixels)).data();
  }
};

template <class T>
Runs runs_pixel_by_pixel(const GuardedRow<T>& row, int width, T least) {
  Runs runs;
  for (int x = 0; x < width; ++x) {
    if (row.counts[x] < least || row.validity[x] != static_cast<std::uint8_t>(Validity::Seen)) {
      continue;
    }
    if (!runs.empty() && runs.back().second == x) {
      ++runs.back().second;
    } else {
      runs.emplace_back(x, x + 1);
    }
  }
  return runs;
}

template <class T>
class Edges : public testing::Test {};
using CountTypes = testing::Types<std::uint8_t, std::uint16_t>;
TYPED_TEST_SUITE(Edges, CountTypes);

TYPED_TEST(Edges, AreThoseThatAPixelByPixelSearchFindsAndNothingElseIsRead) {
  using T = TypeParam;
  std::mt19937 random(1);
  const auto chance = [&](double share) { return std::bernoulli_distribution(share)(random); };
  GuardedRow<T> row;
  EdgeFinder finder(kWidest);
  for (int width = 0; width <= kWidest; ++width) {
    for (int round = 0; round < 40; ++round) {
      row.place(width, round % 2 == 0);
      const auto least = static_cast<T>(chance(0.1)   ? 0
                                        : chance(0.1) ? std::numeric_limits<T>::max()
                                                      : 1 + random() % 250);
      const double hot = std::uniform_real_distribution<double>(0, 1)(random);
      const double lasting = chance(0.5) ? 0.95 : 0;  // 0.95: blobs, 0: noise
      const double unseen = chance(0.5) ? 0 : 0.05;
      bool is_hot = false;
      for (int x = 0; x < width; ++x) {
        if (!chance(lasting)) is_hot = chance(hot);
        // Ties, both sides of the threshold, and the ends of the range.
        const int above = chance(0.5) ? 0 : static_cast<int>(random() % 256);
        const int below = 1 + static_cast<int>(chance(0.5) ? 0 : random() % 256);
        const int count = is_hot ? least + above : least - below;
        row.counts[x] = static_cast<T>(std::clamp<int>(count, 0, std::numeric_limits<T>::max()));
        row.validity[x] = chance(unseen) ? static_cast<std::uint8_t>(random() % 255) : 255;
      }
      Runs found;
      finder.for_each_run<T>(row.counts, row.validity, {0, 0, width}, least,
                             [&](int begin, int end) { found.emplace_back(begin, end); });
      ASSERT_EQ(found, runs_pixel_by_pixel(row, width, least))
          << width << " pixels, round " << round;
    }
  }
}

TEST(CountAtLeast, IsTheLeastWholeOneOfItsType) {
  EXPECT_EQ(count_at_least<std::uint8_t>(0), 0);
  EXPECT_EQ(count_at_least<std::uint8_t>(99.01), 100);
  EXPECT_EQ(count_at_least<std::uint8_t>(255), 255);
  EXPECT_EQ(count_at_least<std::uint8_t>(255.5), std::nullopt);
  EXPECT_EQ(count_at_least<std::uint16_t>(65535), 65535);
  EXPECT_EQ(count_at_least<std::uint16_t>(65536), std::nullopt);
}

}  // namespace
}  // namespace orbwatch::signals
