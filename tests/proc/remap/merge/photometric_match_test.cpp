// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/merge/photometric_match.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace orbwatch::remap {
namespace {

using Channel = PhotometricMatch::Channel;
using Outcome = PhotometricMatch::Outcome;
using Channels = std::array<Channel, 3>;

constexpr int kShotWidth = 320, kShotHeight = 200;

/// Light of the scene: smooth structures of some blocks' size, different in each channel.
double scene(int x, int y, int k) {
  return 0.25 + 0.1 * std::sin(0.05 * x + 0.9 * k) + 0.08 * std::cos(0.07 * y - 0.4 * k) +
         0.04 * std::sin(0.021 * (x + 2 * y));
}

/// IEC 61966-2-1, an independent implementation.
double srgb(double light) {
  light = std::clamp(light, 0.0, 1.0);
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

/// A camera that sees columns [first, last) of the scene through channels of its own: its matched
/// picture is the scene's light.
template <class T>
struct Shot {
  static constexpr double kFull = std::numeric_limits<T>::max();

  Shot(int samples_per_pixel, Transfer transfer, const Channels& match, int first = 0,
       int last = kShotWidth)
      : channels(samples_per_pixel),
        picture(kShotWidth * kShotHeight * samples_per_pixel),
        weights(kShotWidth * kShotHeight) {
    for (int y = 0; y < kShotHeight; ++y) {
      for (int x = first; x < last; ++x) {
        weights[y * kShotWidth + x] = 128;
        for (int k = 0; k < channels; ++k) {
          const double light = (scene(x, y, k) - match[k].offset) / match[k].gain;
          const double sample = transfer == Transfer::Srgb ? srgb(light) : light;
          at(x, y, k) = static_cast<T>(std::lround(std::clamp(sample, 0.0, 1.0) * kFull));
        }
      }
    }
  }
  T& at(int x, int y, int k) { return picture[(y * kShotWidth + x) * channels + k]; }
  ImageView<T> view() {
    return {picture.data(), kShotWidth, kShotHeight, channels, kShotWidth * channels};
  }
  MergeSource<T> source() {
    return {view(), {weights.data(), kShotWidth, kShotHeight, 1, kShotWidth}};
  }

  int channels;
  std::vector<T> picture;
  std::vector<std::uint8_t> weights;
};

const Channels kDarkAndWarm{{{1.7, 0.01}, {2.2, -0.02}, {2.9, 0.015}}};
const Channels kBrightAndCold{{{0.8, 0.02}, {0.7, 0.0}, {0.55, -0.01}}};

void expect_near(const PhotometricMatch& found, const Channels& truth, int channels) {
  ASSERT_EQ(found.outcome, Outcome::Matched);
  for (int k = 0; k < channels; ++k) {
    EXPECT_NEAR(found.channels[k].gain, truth[k].gain, 0.01 * truth[k].gain) << k;
    EXPECT_NEAR(found.channels[k].offset, truth[k].offset, 0.002) << k;
  }
}

void expect_identity(const PhotometricMatch& match) {
  for (const Channel& channel : match.channels) {
    EXPECT_EQ(channel.gain, 1);
    EXPECT_EQ(channel.offset, 0);
  }
}

template <class T>
constexpr PixelFormat kColour = sizeof(T) == 1 ? PixelFormat::Rgb : PixelFormat::Rgb16;

template <class T>
class PhotometricMatchOf : public testing::Test {};
using Samples = testing::Types<std::uint8_t, std::uint16_t>;
TYPED_TEST_SUITE(PhotometricMatchOf, Samples);

TYPED_TEST(PhotometricMatchOf, RecoversGainAndOffsetInLinearLight) {
  for (const Transfer transfer : {Transfer::Srgb, Transfer::Linear}) {
    for (const int channels : {1, 3}) {
      for (const Channels& truth : {kDarkAndWarm, kBrightAndCold}) {
        Shot<TypeParam> a(channels, transfer, {}), b(channels, transfer, truth);
        const auto matches =
            match_photometry<TypeParam>(std::array{a.source(), b.source()}, transfer);
        ASSERT_EQ(matches.size(), 2U);
        EXPECT_EQ(matches[0].outcome, Outcome::Reference);
        expect_identity(matches[0]);
        expect_near(matches[1], truth, channels);
      }
    }
  }
}

TYPED_TEST(PhotometricMatchOf, ApplyingItMakesThePicturesEqual) {
  Shot<TypeParam> a(3, Transfer::Srgb, {}), b(3, Transfer::Srgb, kDarkAndWarm);
  const auto matches =
      match_photometry<TypeParam>(std::array{a.source(), b.source()}, Transfer::Srgb);
  PhotometricTable(matches[1], kColour<TypeParam>).apply(b.view(), kColour<TypeParam>);
  double worst = 0;
  for (std::size_t i = 0; i < a.picture.size(); ++i) {
    worst = std::max(worst, std::abs(double{0} + a.picture[i] - b.picture[i]) / a.kFull);
  }
  EXPECT_LT(worst, 0.012) << "three levels of eight bits: the darker picture has coarser steps";
}

TYPED_TEST(PhotometricMatchOf, TheIdentityChangesNothing) {
  Shot<TypeParam> a(3, Transfer::Srgb, {});
  const auto before = a.picture;
  PhotometricTable({}, kColour<TypeParam>).apply(a.view(), kColour<TypeParam>);
  EXPECT_EQ(a.picture, before);
}

class PhotometricMatchTest : public testing::Test {
 protected:
  using Shot8 = Shot<std::uint8_t>;
  static std::vector<PhotometricMatch> match(std::vector<MergeSource<std::uint8_t>> sources) {
    return match_photometry<std::uint8_t>(sources, Transfer::Srgb);
  }
};

TEST_F(PhotometricMatchTest, LeavesPicturesWithoutOverlapAlone) {
  Shot8 a(3, Transfer::Srgb, {}, 0, 160), b(3, Transfer::Srgb, kDarkAndWarm, 160);
  const auto matches = match({a.source(), b.source()});
  EXPECT_EQ(matches[1].outcome, Outcome::TooLittle);
  expect_identity(matches[1]);
}

TEST_F(PhotometricMatchTest, AConstantPictureHasAGainAlone) {
  Shot8 a(3, Transfer::Srgb, {}), b(3, Transfer::Srgb, {});
  std::fill(a.picture.begin(), a.picture.end(), std::uint8_t{188});
  std::fill(b.picture.begin(), b.picture.end(), std::uint8_t{137});
  const auto matches = match({a.source(), b.source()});
  ASSERT_EQ(matches[1].outcome, Outcome::Matched);
  // sRGB 188 and 137 are 50.29 % and 25.02 % of full light.
  EXPECT_NEAR(matches[1].channels[1].gain, 0.5029 / 0.2502, 0.002);
  EXPECT_NEAR(matches[1].channels[1].offset, 0, 1e-9);
}

TEST_F(PhotometricMatchTest, ToleratesAFifthOfThePictureBeingDifferent) {
  Shot8 a(3, Transfer::Srgb, {}), b(3, Transfer::Srgb, kDarkAndWarm);
  std::mt19937 random(2);
  for (int y = 0; y < kShotHeight; y += 8) {
    for (int x = 0; x < kShotWidth; x += 8) {
      if (random() % 5 != 0) continue;
      const std::array<int, 3> other{100, 150, 120};
      for (int i = 0; i < 64; ++i) {
        for (int k = 0; k < 3; ++k) b.at(x + i % 8, y + i / 8, k) = other[k];
      }
    }
  }
  expect_near(match({a.source(), b.source()})[1], kDarkAndWarm, 3);
}

TEST_F(PhotometricMatchTest, SaturatedAndBlackSamplesDoNotCount) {
  // The second picture clips a third of the scene.
  const Channels bright{{{0.33, 0}, {0.33, 0}, {0.33, 0}}};
  Shot8 a(3, Transfer::Srgb, {}), b(3, Transfer::Srgb, bright);
  ASSERT_GT(std::count(b.picture.begin(), b.picture.end(), 255), kShotWidth * kShotHeight / 4);
  expect_near(match({a.source(), b.source()})[1], bright, 3);
}

TEST_F(PhotometricMatchTest, ASharperCameraDoesNotLookMoreContrasty) {
  // The detail is finer than the second camera resolves.
  Shot8 a(1, Transfer::Srgb, {}), b(1, Transfer::Srgb, kBrightAndCold);
  for (int y = 0; y < kShotHeight; ++y) {
    for (int x = 0; x < kShotWidth; ++x) {
      const double detail = (x + y) % 2 == 0 ? 0.08 : -0.08;
      a.at(x, y, 0) = static_cast<std::uint8_t>(std::lround(255 * srgb(scene(x, y, 0) + detail)));
    }
  }
  expect_near(match({a.source(), b.source()})[1], kBrightAndCold, 1);
}

TEST_F(PhotometricMatchTest, AChainOfSourcesIsMatchedTogether) {
  // The third does not overlap with the first.
  Shot8 a(3, Transfer::Srgb, {}, 0, 140), b(3, Transfer::Srgb, kDarkAndWarm, 60, 260),
      c(3, Transfer::Srgb, kBrightAndCold, 180);
  const auto matches = match({a.source(), b.source(), c.source()});
  expect_near(matches[1], kDarkAndWarm, 3);
  expect_near(matches[2], kBrightAndCold, 3);
}

TEST_F(PhotometricMatchTest, SourcesApartFromTheFirstAreMatchedToOneAnother) {
  Shot8 a(1, Transfer::Srgb, {}, 0, 80), b(1, Transfer::Srgb, {}, 96, 240),
      c(1, Transfer::Srgb, kBrightAndCold, 120);
  const auto matches = match({a.source(), b.source(), c.source()});
  EXPECT_EQ(matches[1].outcome, Outcome::TooLittle);
  expect_identity(matches[1]);
  expect_near(matches[2], kBrightAndCold, 1);
}

TEST_F(PhotometricMatchTest, RefusesAnImplausibleGain) {
  Shot<std::uint16_t> a(1, Transfer::Linear, {}), b(1, Transfer::Linear, {{{40, 0}}});
  const auto matches =
      match_photometry<std::uint16_t>(std::array{a.source(), b.source()}, Transfer::Linear);
  EXPECT_EQ(matches[1].outcome, Outcome::Implausible);
  expect_identity(matches[1]);
}

TEST_F(PhotometricMatchTest, PicturesThatShowDifferentThingsAreLeftAlone) {
  Shot8 a(1, Transfer::Srgb, {}), b(1, Transfer::Srgb, {});
  std::mt19937 random(4);
  for (int y = 0; y < kShotHeight; y += 8) {
    for (int x = 0; x < kShotWidth; x += 8) {
      const auto value = static_cast<std::uint8_t>(60 + random() % 150);
      for (int i = 0; i < 64; ++i) b.at(x + i % 8, y + i / 8, 0) = value;
    }
  }
  EXPECT_EQ(match({a.source(), b.source()})[1].outcome, Outcome::TooLittle);
}

TEST(TransferFunction, RoundTripsAndKnowsItsFormats) {
  for (const Transfer transfer : {Transfer::Srgb, Transfer::Linear}) {
    for (double sample = 0; sample <= 1; sample += 1.0 / 1024) {
      EXPECT_NEAR(from_light(transfer, to_light(transfer, sample)), sample, 1e-7);
    }
  }
  EXPECT_NEAR(to_light(Transfer::Srgb, 188.0 / 255), 0.5029, 1e-4);
  EXPECT_EQ(transfer_of(PixelFormat::Y16), Transfer::Linear);
  EXPECT_EQ(transfer_of(PixelFormat::Rgb16), Transfer::Srgb);
}

}  // namespace
}  // namespace orbwatch::remap
