// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "proc/image/image_view.h"
#include "proc/optics/rotation.h"
#include "proc/remap/merge/merged_remap.h"
#include "proc/remap/merge/source_tiles.h"
#include "proc/remap/remap.h"
#include "tests/proc/remap/stored_picture.h"

namespace orbwatch::remap {

inline ColourMap::Table grey_table() {
  ColourMap::Table table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i].fill(static_cast<std::uint8_t>(i));
  return table;
}

/// Cameras around a ball, and everything that a merged view of them needs.
class MergedScene : public testing::Test {
 protected:
  using BallModel = optics::BallModel;
  using BallProjection = optics::BallProjection;
  using ViewKind = optics::ViewKind;
  using ViewProjection = optics::ViewProjection;
  using StoredPicture = tests::StoredPicture;

  static constexpr int kSide = 300, kWidth = 500, kHeight = 250;

  struct Camera {
    Camera(const ViewProjection& view, double yaw, PixelFormat format, std::uint32_t seed)
        : ball(BallProjection::make(BallModel::make(BallModel::Kind::Exact, 345).value(),
                                    {{149.5, 149.5}, 140, 140, 0}, optics::rotation({yaw, 0, 0}))
                   .value()),
          grid(view, ball, kSide, kSide),
          source(format, kSide, kSide) {
      source.fill_with_noise(seed);
    }
    BallProjection ball;
    CoordinateGrid grid;
    StoredPicture source;
    double weight = 1;
    bool delivers = true;
    std::optional<PhotometricTable> match;
  };

  void add(double yaw, PixelFormat format = PixelFormat::Rgb) {
    cameras.push_back(std::make_unique<Camera>(view, yaw, format,
                                               static_cast<std::uint32_t>(cameras.size() + 1)));
  }

  void compile() {
    std::vector<BlendSource> sources;
    for (const auto& c : cameras)
      sources.push_back({c->ball, kSide, kSide, c->weight, std::nullopt});
    blend.emplace(view, sources);
  }

  void render(MergeRule rule = MergeRule::Mean, std::optional<TileRows> rows = std::nullopt,
              const Kernel& kernel = default_kernel()) {
    std::vector<MergedSource> sources;
    for (const auto& c : cameras) {
      MergedSource source{&c->grid, {}, &colours, {}, nullptr};
      if (c->delivers) source.pictures = c->source.as_source();
      if (c->match) source.match = &*c->match;
      if (c == cameras.front()) {
        source.measured = measured;
        if (unsharpened) source.measured_pictures = unsharpened->as_source();
      }
      sources.push_back(source);
    }
    const MergePlan plan{&*blend, rule, Interpolation::Bilinear, view_of(unseen, 1)};
    merged_remap(sources, plan, target.value_or(picture_of(PixelFormat::Rgb, view_of(rgb, 3))),
                 view_of(validity, 1), rows.value_or(TileRows{0, cameras.front()->grid.tiles_y()}),
                 kernel);
  }

  /// The view of source `n` alone, by remap().
  std::vector<std::uint8_t> alone(std::size_t n) {
    std::vector<std::uint8_t> out(rgb.size());
    const CoordinateGrid& grid = cameras[n]->grid;
    const Picture& source = cameras[n]->source.source;
    if (source.format != PixelFormat::Y16) {
      remap(grid, cameras[n]->source.as_source(), Interpolation::Bilinear,
            picture_of(PixelFormat::Rgb, view_of(out, 3)), {0, grid.tiles_y()});
      return out;
    }
    std::vector<std::uint16_t> counts(out.size() / 3);
    const ImageView<std::uint16_t> values{counts.data(), kWidth, kHeight, 1, kWidth};
    remap(grid, cameras[n]->source.as_source(), Interpolation::Bilinear,
          picture_of(PixelFormat::Y16, values), {0, grid.tiles_y()});
    for (int ty = 0; ty < grid.tiles_y(); ++ty) {
      for (int tx = 0; tx < grid.tiles_x(); ++tx) {
        const TileArea area = area_of(grid, tx, ty);
        colours.apply(part(values, area), part(view_of(out, 3), area), scalar_kernel());
      }
    }
    return out;
  }
  std::vector<std::uint8_t> weights(std::size_t n) {
    std::vector<std::uint8_t> out(validity.size());
    blend->weights(n, cameras[n]->grid, view_of(out, 1));
    return out;
  }
  static ImageView<std::uint8_t> view_of(std::vector<std::uint8_t>& samples, int channels) {
    return {samples.data(), kWidth, kHeight, channels, kWidth * channels};
  }

  /// Compares every pixel with the weighted mean of the sources alone; a share below half a percent
  /// may be missing.
  void expect_mean() {
    std::vector<std::vector<std::uint8_t>> pictures, shares;
    for (std::size_t n = 0; n < cameras.size(); ++n) {
      pictures.push_back(alone(n));
      shares.push_back(weights(n));
      if (!cameras[n]->delivers) std::fill(shares[n].begin(), shares[n].end(), 0);
    }
    for (std::size_t i = 0; i < validity.size(); ++i) {
      double total = 0;
      for (const auto& share : shares) total += share[i];
      ASSERT_EQ(validity[i], total > 0 ? static_cast<int>(Validity::Seen) : unseen[i]) << i;
      for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
        double sum = 0;
        for (std::size_t n = 0; n < shares.size(); ++n)
          sum += double{1} * shares[n][i] * pictures[n][k];
        ASSERT_NEAR(rgb[k], total > 0 ? sum / total : 0, 2.6) << i;
      }
    }
  }

  ViewProjection view =
      ViewProjection::make({ViewKind::Equirectangular, {}, {}, {}, kWidth, kHeight}).value();
  ColourMap colours{grey_table(), 0, 65535};
  std::vector<std::unique_ptr<Camera>> cameras;
  std::optional<BlendGrid> blend;
  std::optional<MutablePicture> target;  ///< used in place of `rgb`
  MutablePicture measured;               ///< the first camera's
  /// The first camera's picture, if a sharpened one is shown.
  std::unique_ptr<StoredPicture> unsharpened;
  std::vector<std::uint8_t> rgb = std::vector<std::uint8_t>(3 * kWidth * kHeight, 77);
  std::vector<std::uint8_t> validity = std::vector<std::uint8_t>(kWidth * kHeight, 3);
  std::vector<std::uint8_t> unseen =
      std::vector<std::uint8_t>(kWidth * kHeight, static_cast<std::uint8_t>(Validity::Blind));
};

/// The Y of a YUV picture in its stored form.
inline std::unique_ptr<tests::StoredPicture> luminance_plane(const tests::StoredPicture& yuv) {
  const PixelFormat format = yuv.picture.format;
  const int width = yuv.picture.width, height = yuv.picture.height;
  auto grey = std::make_unique<tests::StoredPicture>(PixelFormat::Grey, width, height);
  const int step = info(format).channels(), first = format == PixelFormat::Uyvy ? 1 : 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      grey->picture.samples<std::uint8_t>().at(x, y)[0] = yuv.sample(0, y, step * x + first);
    }
  }
  return grey;
}

}  // namespace orbwatch::remap
