// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/merge/merged_remap.h"
#include "proc/remap/merge/source_tiles.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "proc/image/image_view.h"
#include "proc/remap/remap.h"
#include "tests/proc/remap/merge/merged_scene.h"
#include "tests/proc/remap/stored_picture.h"

namespace orbwatch::remap {
namespace {

using tests::StoredPicture;

class MergedRemap : public MergedScene {};

TEST_F(MergedRemap, OneSourceIsRemappedAsItIs) {
  add(20);
  compile();
  render();
  EXPECT_EQ(rgb, alone(0));
  expect_mean();
}

TEST_F(MergedRemap, SeveralAreTheMeanByWeight) {
  add(0);
  add(120, PixelFormat::Nv12);
  add(-120, PixelFormat::Y16);
  compile();
  render();
  expect_mean();
}

TEST_F(MergedRemap, BgrIsRgbInTheOtherOrder) {
  add(0);
  add(120, PixelFormat::Nv12);
  add(-120, PixelFormat::Y16);
  compile();
  render();
  StoredPicture bgr(PixelFormat::Bgr, kWidth, kHeight);
  target = bgr.picture;
  render();
  for (int i = 0; i < kWidth * kHeight; ++i) {
    for (int k = 0; k < 3; ++k) {
      ASSERT_EQ(bgr.sample(0, i / kWidth, 3 * (i % kWidth) + 2 - k), rgb[3 * i + k]) << i;
    }
  }
}

// Each format beside a colour-mapped camera and one of matched exposure.
TEST_F(MergedRemap, IsTheSameFromEveryKernel) {
  using enum PixelFormat;
  PhotometricMatch darker;
  darker.channels.fill({0.8, 0.01});
  for (const PixelFormat format : {Rgb, Bgr, Bgra, Nv12, Nv21, I420, Yuyv, Uyvy, Grey}) {
    cameras.clear();
    add(0, format);
    add(60, Y16);
    add(-60, format);
    if (format != Grey) cameras[2]->match.emplace(darker, Rgb);
    compile();
    for (const PixelFormat view_format : {Rgb, Bgr, I420}) {
      StoredPicture expected(view_format, kWidth, kHeight), found(view_format, kWidth, kHeight);
      expected.picture.colour_space = found.picture.colour_space = kJfif;
      target = expected.picture;
      render(MergeRule::Mean, std::nullopt, scalar_kernel());
      target = found.picture;
      for (const Kernel* kernel : kernels()) {
        render(MergeRule::Mean, std::nullopt, *kernel);
        EXPECT_EQ(found.bytes, expected.bytes)
            << kernel->name << ", " << info(format).name << " to " << info(view_format).name;
      }
    }
  }
}

/// A source's view alone, all of it 8 bit, as Grey.
std::vector<std::uint8_t> luma_of(const std::vector<std::uint8_t>& rgb) {
  std::vector<std::uint8_t> grey(rgb.size() / 3);
  luma(rgb.data(), grey.data(), static_cast<int>(grey.size()));
  return grey;
}

TEST_F(MergedRemap, GreyIsTheMeanOfTheLuminances) {
  add(0);
  add(120, PixelFormat::Nv12);
  add(-120, PixelFormat::Y16);
  compile();
  cameras[1]->source.source.colour_space.range = ColourRange::Full;
  StoredPicture grey(PixelFormat::Grey, kWidth, kHeight), own(PixelFormat::Grey, kWidth, kHeight);
  target = grey.picture;
  render();
  // The conversion does not use colours, which clip values outside RGB.
  remap(cameras[1]->grid, luminance_plane(cameras[1]->source)->as_source(), Interpolation::Bilinear,
        own.picture, {0, cameras[1]->grid.tiles_y()});
  std::vector<std::vector<std::uint8_t>> pictures{luma_of(alone(0)), {}, luma_of(alone(2))};
  for (const std::byte byte : own.bytes) pictures[1].push_back(static_cast<std::uint8_t>(byte));
  const std::array shares{weights(0), weights(1), weights(2)};
  for (int i = 0; i < kWidth * kHeight; ++i) {
    double sum = 0, total = 0;
    for (std::size_t n = 0; n < 3; ++n) {
      sum += double{1} * shares[n][i] * pictures[n][i];
      total += shares[n][i];
    }
    ASSERT_NEAR(grey.sample(0, i / kWidth, i % kWidth), total > 0 ? sum / total : 0, 2.6) << i;
  }
}

TEST_F(MergedRemap, WithoutAPictureItMeasuresAndSeesTheSame) {
  add(0, PixelFormat::Y16);
  add(10, PixelFormat::Nv12);
  add(180);
  compile();
  for (const bool delivers : {true, false}) {
    cameras[2]->delivers = delivers;
    StoredPicture beside(PixelFormat::Y16, kWidth, kHeight),
        counts(PixelFormat::Y16, kWidth, kHeight);
    measured = beside.picture;
    target.reset();
    render();
    const auto seen = validity;
    std::fill(validity.begin(), validity.end(), 77);
    measured = counts.picture;
    target = MutablePicture{};
    render();
    EXPECT_EQ(counts.bytes, beside.bytes);
    EXPECT_EQ(validity, seen);
    EXPECT_EQ(delivers, std::ranges::count(seen, static_cast<std::uint8_t>(Validity::Blind)) == 0);
  }
}

TEST_F(MergedRemap, TheOthersStandInForOneThatDoesNotDeliver) {
  add(0);
  add(170);
  compile();
  for (const std::size_t missing : {0U, 1U}) {
    for (std::size_t n = 0; n < 2; ++n) cameras[n]->delivers = n != missing;
    render();
    expect_mean();
    EXPECT_EQ(rgb, alone(1 - missing));
  }
  for (const auto& camera : cameras) camera->delivers = false;
  render();
  expect_mean();
  EXPECT_EQ(*std::max_element(rgb.begin(), rgb.end()), 0);
}

/// Bytes that a read would crash on.
class UnreadableMemory {
 public:
  explicit UnreadableMemory(std::size_t bytes)
      : bytes_(bytes),
        begin_(::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)) {
    if (begin_ == MAP_FAILED) std::abort();
  }
  ~UnreadableMemory() { ::munmap(begin_, bytes_); }
  UnreadableMemory(const UnreadableMemory&) = delete;
  UnreadableMemory& operator=(const UnreadableMemory&) = delete;

  const std::byte* begin() const { return static_cast<const std::byte*>(begin_); }

 private:
  std::size_t bytes_;
  void* begin_;
};

TEST_F(MergedRemap, DoesNotReadWhatIsBehindTheFirst) {
  add(20);
  add(20);
  compile();
  const UnreadableMemory hidden(cameras[1]->source.bytes.size());
  cameras[1]->source.source.planes[0].data = hidden.begin();
  render(MergeRule::First);
  EXPECT_EQ(rgb, alone(0));
}

TEST_F(MergedRemap, TheFirstThatSeesHasAPixelAlone) {
  add(0);
  add(180);
  compile();
  render(MergeRule::First);
  const auto first = alone(0), second = alone(1);
  const auto sees = weights(0);
  int from_second = 0;
  for (std::size_t i = 0; i < validity.size(); ++i) {
    const auto& truth = sees[i] > 0 ? first : second;
    from_second += sees[i] == 0;
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) ASSERT_EQ(rgb[k], truth[k]) << i;
  }
  EXPECT_GT(from_second, 100);
}

TEST_F(MergedRemap, WhatIsMeasuredIsTheSourceAloneWhetherItCountsOrNot) {
  add(0, PixelFormat::Y16);
  add(10);
  add(180);
  compile();
  StoredPicture counts(PixelFormat::Y16, kWidth, kHeight), truth(PixelFormat::Y16, kWidth, kHeight);
  measured = counts.picture;
  remap(cameras[0]->grid, cameras[0]->source.as_source(), Interpolation::Bilinear, truth.picture,
        {0, cameras[0]->grid.tiles_y()});
  render();
  EXPECT_EQ(counts.bytes, truth.bytes);
  expect_mean();

  cameras[0]->delivers = false;
  render();
  for (const std::byte byte : counts.bytes) ASSERT_EQ(byte, std::byte{0});
}

TEST_F(MergedRemap, TheLuminanceOfColourIsMeasured) {
  add(0);
  add(150);
  compile();
  StoredPicture luminance(PixelFormat::Grey, kWidth, kHeight);
  measured = luminance.picture;
  render();
  const auto truth = alone(0);
  for (int i = 0; i < kWidth * kHeight; ++i) {
    ASSERT_EQ(luminance.sample(0, i / kWidth, i % kWidth),
              luma(&truth[3 * static_cast<std::size_t>(i)]));
  }
}

TEST_F(MergedRemap, WhatIsMeasuredOfColourIsNotWhatWasSharpenedToBeShown) {
  for (const PixelFormat format : {PixelFormat::Rgb, PixelFormat::Bgr, PixelFormat::Bgra,
                                   PixelFormat::Nv12, PixelFormat::I420, PixelFormat::Uyvy}) {
    SCOPED_TRACE(orbwatch::info(format).name);
    cameras.clear();
    add(0, format);
    add(150);
    compile();
    StoredPicture from_own(PixelFormat::Grey, kWidth, kHeight),
        from_other(PixelFormat::Grey, kWidth, kHeight);
    measured = from_own.picture;
    render();
    unsharpened = std::make_unique<StoredPicture>(format, kSide, kSide);
    unsharpened->bytes = cameras[0]->source.bytes;
    cameras[0]->source.fill_with_noise(7);
    measured = {};
    render();
    const auto shown = rgb;
    measured = from_other.picture;
    render();
    EXPECT_EQ(from_other.bytes, from_own.bytes);
    EXPECT_EQ(rgb, shown);
    unsharpened.reset();
  }
}

class MergedYuv : public MergedRemap,
                  public testing::WithParamInterface<std::tuple<PixelFormat, ColourMatrix>> {};

// Noise holds every colour, most of them outside RGB.
TEST_P(MergedYuv, ItsLuminanceIsTheCamerasOwnInFullRange) {
  const auto [format, matrix] = GetParam();
  for (const ColourRange range : {ColourRange::Limited, ColourRange::Full}) {
    cameras.clear();
    add(0, format);
    add(150);
    compile();
    cameras[0]->source.source.colour_space = {matrix, range};
    StoredPicture luminance(PixelFormat::Grey, kWidth, kHeight),
        own(luminance.picture.format, kWidth, kHeight);
    measured = luminance.picture;
    render();
    expect_mean();
    remap(cameras[0]->grid, luminance_plane(cameras[0]->source)->as_source(),
          Interpolation::Bilinear, own.picture, {0, cameras[0]->grid.tiles_y()});
    for (int i = 0; i < kWidth * kHeight; ++i) {
      const int y = own.sample(0, i / kWidth, i % kWidth);
      const double full = range == ColourRange::Full ? y : (y - 16) * 255.0 / 219;
      ASSERT_NEAR(luminance.sample(0, i / kWidth, i % kWidth), std::clamp(full, 0.0, 255.0), 0.53)
          << i % kWidth << ", " << i / kWidth;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Formats, MergedYuv,
    testing::Combine(testing::Values(PixelFormat::Yuyv, PixelFormat::Uyvy, PixelFormat::Nv12,
                                     PixelFormat::Nv21, PixelFormat::I420),
                     testing::Values(ColourMatrix::Bt601, ColourMatrix::Bt709)),
    [](const auto& test) {
      return std::string(orbwatch::info(std::get<0>(test.param)).name) +
             (std::get<1>(test.param) == ColourMatrix::Bt601 ? "_bt601" : "_bt709");
    });

/// Two sources of one format in a view of that format, the second one matched.
template <class T>
void expect_mean_of(const StoredPicture& out, const StoredPicture& first,
                    const StoredPicture& second, const std::vector<std::uint8_t>& first_weights,
                    const std::vector<std::uint8_t>& second_weights) {
  const auto merged = out.picture.samples<T>(), a = first.picture.samples<T>(),
             b = second.picture.samples<T>();
  // The tolerance of 8 bit: a share below half a percent may be missing.
  const double tolerance = 2.6 / 255 * std::numeric_limits<T>::max();
  for (std::size_t i = 0; i < first_weights.size(); ++i) {
    const int x = static_cast<int>(i) % merged.width, y = static_cast<int>(i) / merged.width;
    const double u = first_weights[i], v = second_weights[i];
    for (int k = 0; k < merged.channels; ++k) {
      const double sum = u * a.at(x, y)[k] + v * b.at(x, y)[k];
      ASSERT_NEAR(merged.at(x, y)[k], u + v > 0 ? sum / (u + v) : 0, tolerance) << x << ", " << y;
    }
  }
}

TEST_F(MergedRemap, AViewMayHaveTheFormatOfItsSourcesWhichAreMatched) {
  for (const PixelFormat format : {PixelFormat::Grey, PixelFormat::Y16, PixelFormat::Rgb16}) {
    cameras.clear();
    add(0, format);
    add(120, format);
    compile();
    PhotometricMatch darker;
    darker.channels.fill({0.4, 0.01});
    const PhotometricTable table(darker, format);
    const TileRows rows{0, cameras[0]->grid.tiles_y()};
    const bool is_wide = info(format).bytes_per_sample() == 2;
    std::vector<std::unique_ptr<StoredPicture>> own;
    std::vector<MergedSource> sources;
    for (const auto& c : cameras) {
      own.push_back(std::make_unique<StoredPicture>(format, kWidth, kHeight));
      remap(c->grid, c->source.as_source(), Interpolation::Bilinear, own.back()->picture, rows);
      sources.push_back({&c->grid, c->source.as_source(), nullptr, {}, nullptr});
    }
    sources[1].match = &table;
    is_wide ? table.apply(own[1]->picture.samples<std::uint16_t>(), format)
            : table.apply(own[1]->picture.samples<std::uint8_t>(), format);
    StoredPicture out(format, kWidth, kHeight);
    merged_remap(sources, {&*blend, MergeRule::Mean, Interpolation::Bilinear, view_of(unseen, 1)},
                 out.picture, view_of(validity, 1), rows);
    is_wide ? expect_mean_of<std::uint16_t>(out, *own[0], *own[1], weights(0), weights(1))
            : expect_mean_of<std::uint8_t>(out, *own[0], *own[1], weights(0), weights(1));
  }
}

TEST_F(MergedRemap, RowsMayBeFilledInAnyOrder) {
  add(0);
  add(90, PixelFormat::Yuyv);
  compile();
  render();
  const auto picture = rgb, valid = validity;
  std::fill(rgb.begin(), rgb.end(), 1);
  for (int row = cameras.front()->grid.tiles_y() - 1; row >= 0; --row) {
    render(MergeRule::Mean, TileRows{row, row + 1});
  }
  EXPECT_EQ(rgb, picture);
  EXPECT_EQ(validity, valid);
}

}  // namespace
}  // namespace orbwatch::remap
