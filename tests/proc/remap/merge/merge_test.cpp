// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/merge/merge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "proc/image/image_view.h"

namespace orbwatch::remap {
namespace {

/// Sources of noise: odd sizes, so that the last tiles are cut.
template <class T>
struct NoiseScene {
  static constexpr int kWidth = 37, kHeight = 21, kPixels = kWidth * kHeight;

  NoiseScene(std::size_t count, int samples_per_pixel, std::uint32_t seed)
      : channels(samples_per_pixel), random(seed) {
    for (std::size_t n = 0; n < count; ++n) {
      pictures.emplace_back(kPixels * channels);
      weights.emplace_back(kPixels);
      for (auto& sample : pictures[n]) sample = static_cast<T>(random());
      for (auto& weight : weights[n]) weight = random() % 3 == 0 ? 0 : random() & 0xff;
    }
    out.assign(kPixels * channels, 99);
    validity.assign(kPixels, static_cast<std::uint8_t>(Validity::Blind));
  }

  template <class S>
  static ImageView<S> view(std::vector<S>& samples, int per_pixel) {
    return {samples.data(), kWidth, kHeight, per_pixel, kWidth * per_pixel};
  }
  std::vector<MergeSource<T>> sources() {
    std::vector<MergeSource<T>> list;
    for (std::size_t n = 0; n < pictures.size(); ++n) {
      list.push_back({view(pictures[n], channels), view(weights[n], 1)});
    }
    return list;
  }
  void merge(TileRows rows = {0, 2}, MergeRule rule = MergeRule::Mean) {
    remap::merge<T>(rule, sources(), view(out, channels), view(validity, 1), rows);
  }
  void merge_first() { merge({0, 2}, MergeRule::First); }
  std::uint64_t total(std::size_t i) const {
    std::uint64_t sum = 0;
    for (const auto& plane : weights) sum += plane[i];
    return sum;
  }

  int channels;
  std::mt19937 random;
  std::vector<std::vector<T>> pictures;
  std::vector<std::vector<std::uint8_t>> weights;
  std::vector<T> out;
  std::vector<std::uint8_t> validity;
};

template <class T>
class Merge : public testing::Test {};
using Samples = testing::Types<std::uint8_t, std::uint16_t>;
TYPED_TEST_SUITE(Merge, Samples);

TYPED_TEST(Merge, IsTheMeanByWeightRoundedExactly) {
  for (std::size_t count = 1; count <= kMaxSources; ++count) {
    for (const int channels : {1, 3}) {
      NoiseScene<TypeParam> scene(count, channels, static_cast<std::uint32_t>(10 * count));
      scene.merge();
      for (std::size_t i = 0; i < scene.kPixels; ++i) {
        const std::uint64_t total = scene.total(i);
        for (int k = 0; k < channels; ++k) {
          const std::size_t s = channels * i + k;
          std::uint64_t sum = 0;
          for (std::size_t n = 0; n < count; ++n) {
            sum += std::uint64_t{scene.weights[n][i]} * scene.pictures[n][s];
          }
          ASSERT_EQ(scene.out[s], total ? (sum + total / 2) / total : 0)
              << count << " sources, " << channels << " channels, sample " << s;
        }
        ASSERT_EQ(scene.validity[i], static_cast<int>(total ? Validity::Seen : Validity::Blind));
      }
    }
  }
}

TYPED_TEST(Merge, IsExactForEverySumOfWeightsAndTheLargestSamples) {
  constexpr TypeParam kTop = std::numeric_limits<TypeParam>::max();
  for (int base = 0; base <= 765; base += 255) {
    NoiseScene<TypeParam> scene(kMaxSources, 1, 1);
    for (int i = 0; i < scene.kPixels; ++i) {
      for (int n = 0; n < 3; ++n) scene.weights[n][i] = base > 255 * n ? 255 : 0;
      scene.weights[3][i] = static_cast<std::uint8_t>(i % 256);
      for (auto& picture : scene.pictures) picture[i] = static_cast<TypeParam>(kTop - i % 2);
    }
    scene.merge();
    for (int i = 0; i < scene.kPixels; ++i) {
      ASSERT_EQ(scene.out[i], scene.total(i) ? kTop - i % 2 : 0) << base << " " << i;
    }
  }
}

TYPED_TEST(Merge, IsExactWhereAllSeeAndWeightsAddUpToAllOrOneMore) {
  for (const int all : {255, 256}) {
    for (const int channels : {1, 3}) {
      for (int weight = 1; weight < 256; ++weight) {
        NoiseScene<TypeParam> scene(2, channels, static_cast<std::uint32_t>(weight));
        for (std::size_t i = 0; i < scene.kPixels; ++i) {
          scene.weights[0][i] = static_cast<std::uint8_t>(i % 7 == 0 ? 255 : weight);
          scene.weights[1][i] = static_cast<std::uint8_t>(i % 7 == 0 ? 1 : all - weight);
        }
        scene.merge();
        for (std::size_t s = 0; s < scene.out.size(); ++s) {
          const std::size_t i = s / channels;
          const std::uint64_t sum = std::uint64_t{scene.weights[0][i]} * scene.pictures[0][s] +
                                    std::uint64_t{scene.weights[1][i]} * scene.pictures[1][s];
          const std::uint64_t total = scene.total(i);
          ASSERT_EQ(scene.out[s], (sum + total / 2) / total) << weight << " of " << all;
        }
      }
    }
  }
}

TYPED_TEST(Merge, ASourceAlonePassesUnchangedWhateverItsWeight) {
  for (int weight = 1; weight < 256; ++weight) {
    NoiseScene<TypeParam> scene(2, 3, static_cast<std::uint32_t>(weight));
    std::fill(scene.weights[0].begin(), scene.weights[0].end(), static_cast<std::uint8_t>(weight));
    std::fill(scene.weights[1].begin(), scene.weights[1].end(), std::uint8_t{0});
    scene.merge();
    ASSERT_EQ(scene.out, scene.pictures[0]) << weight;
  }
}

TYPED_TEST(Merge, MayWriteIntoOneOfItsPictures) {
  NoiseScene<TypeParam> apart(2, 3, 7), same(2, 3, 7);
  apart.merge();
  merge<TypeParam>(MergeRule::Mean, same.sources(), same.view(same.pictures[1], 3),
                   same.view(same.validity, 1), {0, 2});
  EXPECT_EQ(same.pictures[1], apart.out);
}

TYPED_TEST(Merge, LeavesOtherRowsAlone) {
  NoiseScene<TypeParam> scene(2, 1, 8);
  scene.merge({1, 2});
  constexpr int kFirst = kTile * NoiseScene<TypeParam>::kWidth;
  EXPECT_TRUE(std::all_of(scene.out.begin(), scene.out.begin() + kFirst,
                          [](TypeParam sample) { return sample == 99; }));
  EXPECT_TRUE(std::all_of(scene.validity.begin(), scene.validity.begin() + kFirst,
                          [](auto v) { return v == static_cast<std::uint8_t>(Validity::Blind); }));
}

TYPED_TEST(Merge, WithoutSourcesIsBlackAndLeavesValidity) {
  NoiseScene<TypeParam> scene(0, 3, 9);
  scene.merge();
  EXPECT_EQ(scene.out, std::vector<TypeParam>(scene.out.size(), 0));
  EXPECT_EQ(scene.validity[5], static_cast<int>(Validity::Blind));
}

TYPED_TEST(Merge, FirstThatSeesHasThePixelAlone) {
  for (const int channels : {1, 3}) {
    NoiseScene<TypeParam> scene(3, channels, 11);
    scene.merge_first();
    for (std::size_t i = 0; i < scene.kPixels; ++i) {
      std::size_t first = 0;
      while (first < 3 && scene.weights[first][i] == 0) ++first;
      for (int k = 0; k < channels; ++k) {
        const std::size_t s = channels * i + k;
        ASSERT_EQ(scene.out[s], first < 3 ? scene.pictures[first][s] : 0);
      }
      ASSERT_EQ(scene.validity[i], static_cast<int>(first < 3 ? Validity::Seen : Validity::Blind));
    }
  }
}

}  // namespace
}  // namespace orbwatch::remap
