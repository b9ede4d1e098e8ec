// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/still_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "proc/optics/rotation.h"
#include "tests/app/pipeline/views/rendered_view.h"

namespace orbwatch::app::pipeline {
namespace {

constexpr int kStillSide = 200;

optics::BallProjection still_ball(double yaw) {
  const auto model = optics::BallModel::make(optics::BallModel::Kind::Exact, 340).value();
  return optics::BallProjection::make(model, {{99.5, 99.5}, 95, 95, 0},
                                      optics::rotation({yaw, 0, 0}))
      .value();
}

optics::ViewProjection everything() {
  optics::ViewSpec spec;
  spec.kind = optics::ViewKind::Equirectangular;
  spec.width = 360;
  spec.height = 180;
  return optics::ViewProjection::make(spec, still_ball(0)).value();
}

/// Stripes, `phase` pixels further to the right.
std::vector<std::uint8_t> stripes(int phase) {
  std::vector<std::uint8_t> samples(3 * kStillSide * kStillSide);
  for (std::size_t n = 0; n < samples.size(); ++n) {
    samples[n] = static_cast<std::uint8_t>(40 + (n / 3 % kStillSide + phase) % 17 * 10 + n % 3);
  }
  return samples;
}

Picture rgb_picture(std::vector<std::uint8_t>& samples) {
  return picture_of(PixelFormat::Rgb, ImageView<std::uint8_t>{samples.data(), kStillSide,
                                                              kStillSide, 3, 3 * kStillSide});
}

TEST(StillView, IsTheLiveViewOfThePictures) {
  auto first = stripes(0), second = stripes(8);
  const std::vector<StillSource> sources{{rgb_picture(first), still_ball(0), 0.8},
                                         {rgb_picture(second), still_ball(180), 0}};
  for (const Combine combine : {Combine::Mix, Combine::Sharpest, Combine::Switch}) {
    StillView still = render_once({everything(), PixelFormat::Rgb, combine}, sources);
    EXPECT_TRUE(still.matches.empty());

    ViewPlan plan{0, "live", everything(), {}, combine, {}, std::nullopt};
    hal::FrameSet set;
    for (std::size_t n = 0; n < sources.size(); ++n) {
      const auto frame = std::make_shared<hal::FrameBuffer>();
      frame->picture = sources[n].picture;
      set.frames[n] = frame;
      plan.sources.push_back({n,
                              {PixelFormat::Rgb, {}, kStillSide, kStillSide, 30},
                              sources[n].ball,
                              1,
                              remap::ColourMap({}, 0, 255),
                              sources[n].sharpness});
    }
    WorkerPool workers(0);
    RenderedView rendered(std::move(plan));
    const View& live = rendered.render(set, workers);
    const auto shown = still.picture.samples<std::uint8_t>();
    const auto expected = live.picture.samples<std::uint8_t>();
    const auto validity = still.validity_plane();
    for (int v = 0; v < shown.height; ++v) {
      ASSERT_TRUE(std::equal(shown.at(0, v), shown.at(0, v) + 3 * shown.width, expected.at(0, v)))
          << "row " << v;
      ASSERT_TRUE(
          std::equal(validity.at(0, v), validity.at(0, v) + shown.width, live.validity.at(0, v)))
          << "row " << v;
    }
  }
}

TEST(StillView, KeepsSixteenBitCounts) {
  std::vector<std::uint16_t> counts(kStillSide * kStillSide, 40000);
  const StillSource source{
      picture_of(PixelFormat::Y16,
                 ImageView<std::uint16_t>{counts.data(), kStillSide, kStillSide, 1, kStillSide}),
      still_ball(0)};
  StillView still = render_once({everything(), PixelFormat::Y16}, {&source, 1});
  EXPECT_EQ(still.picture.samples<std::uint16_t>().at(270, 90)[0], 40000);
  EXPECT_EQ(static_cast<Validity>(*still.validity_plane().at(270, 90)), Validity::Seen);
}

}  // namespace
}  // namespace orbwatch::app::pipeline
