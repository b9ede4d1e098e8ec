// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/exposure_match.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <thread>

#include "app/pictures/colour_maps.h"
#include "hal/frame/frame_pool.h"
#include "proc/optics/rotation.h"
#include "tests/app/pipeline/views/rendered_view.h"

namespace orbwatch::app::pipeline {
namespace {

constexpr int kRoomSide = 300;

ViewSource source_in_room(std::size_t camera, PixelFormat format, double yaw) {
  const auto ball = optics::BallProjection::make(
                        optics::BallModel::make(optics::BallModel::Kind::Exact, 340).value(),
                        {{149.5, 149.5}, 140, 140, 0}, optics::rotation({yaw, 0, 0}))
                        .value();
  return {
      camera, {format, {}, kRoomSide, kRoomSide, 30}, ball, 1, {colour_map_table("grey"), 0, 255}};
}

ViewPlan room_panorama(std::vector<ViewSource> sources) {
  const auto projection =
      optics::ViewProjection::make({optics::ViewKind::Equirectangular, {}, {}, {}, 256, 128});
  return {0,
          "all",
          projection.value(),
          std::move(sources),
          Combine::Mix,
          remap::Interpolation::Bilinear,
          std::nullopt};
}

/// Light of a room that varies in all directions, 0..1.
double room(const optics::Vec3& d) {
  return 0.25 + 0.15 * std::sin(5 * d.x) * std::cos(4 * d.y) + 0.08 * std::sin(7 * d.z + d.x);
}

/// Picture of the room in the ball by a camera with a `gain` for the light.
hal::Frame exposed(const ViewSource& source, double gain) {
  auto buffer = hal::make_frame_pool(PixelFormat::Rgb, kRoomSide, kRoomSide, 1).acquire();
  for (int y = 0; y < kRoomSide; ++y) {
    for (int x = 0; x < kRoomSide; ++x) {
      const auto direction = source.ball.direction({double(x), double(y)});
      const double light = direction ? room(*direction) : 0.3;
      const double sample = remap::from_light(remap::Transfer::Srgb, light * gain);
      for (int k = 0; k < 3; ++k) {
        buffer->memory[3 * (kRoomSide * y + x) + k] =
            static_cast<std::byte>(std::lround(255 * sample));
      }
    }
  }
  return buffer;
}

class ExposureMatchTest : public testing::Test {
 protected:
  /// Passes sets a second apart until this number of comparisons was applied.
  void follow(ExposureMatch& match, std::uint64_t comparisons) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (match.comparisons() < comparisons) {
      ASSERT_LT(std::chrono::steady_clock::now(), end);
      set.stamp += std::chrono::seconds(1);
      match.follow(set, *pyramids, workers);
      std::this_thread::yield();
    }
    match.follow(set, *pyramids, workers);
  }
  void deliver(const ViewPlan& plan, const std::vector<double>& gains) {
    std::vector<hal::StreamFormat> formats;
    for (const ViewSource& shown : plan.sources) formats.push_back(shown.format);
    pyramids.emplace(formats);
    for (std::size_t n = 0; n < gains.size(); ++n) {
      set.frames[n] = exposed(plan.sources[n], gains[n]);
    }
    pyramids->build(set, {}, workers);
  }

  WorkerPool workers{1};
  hal::FrameSet set;
  std::optional<FramePyramids> pyramids;
};

TEST_F(ExposureMatchTest, BringsASecondCameraToTheFirst) {
  const ViewPlan plan = room_panorama(
      {source_in_room(0, PixelFormat::Rgb, 0), source_in_room(1, PixelFormat::Rgb, 150)});
  deliver(plan, {1, 0.5});
  ExposureMatch match({&plan, 1});
  EXPECT_EQ(match.table(0), nullptr) << "nothing is compared yet";
  EXPECT_EQ(match.table(1), nullptr);
  follow(match, 1);
  EXPECT_EQ(match.table(0), nullptr) << "the first keeps its exposure";
  ASSERT_NE(match.table(1), nullptr);

  const ViewRenderer renderer(plan);
  View view = make_view(plan);
  set_format(view, PixelFormat::Rgb);
  const auto error = [&] {
    renderer.render(set, *pyramids, view, workers);
    double worst = 0;
    for (int y = 20; y < 108; y += 4) {
      for (int x = 0; x < 256; x += 4) {
        const double truth = room(*plan.projection.direction(x, y));
        const double sample = view.picture.samples<std::uint8_t>().at(x, y)[1] / 255.0;
        worst = std::max(worst,
                         std::abs(remap::to_light(remap::Transfer::Srgb, sample) - truth) / truth);
      }
    }
    return worst;
  };
  EXPECT_GT(error(), 0.4) << "apart";
  pyramids->set_match(1, match.table(1));
  EXPECT_LT(error(), 0.1) << "together";
}

TEST_F(ExposureMatchTest, FollowsSlowly) {
  const ViewPlan plan = room_panorama(
      {source_in_room(0, PixelFormat::Rgb, 0), source_in_room(1, PixelFormat::Rgb, 150)});
  deliver(plan, {1, 1});
  ExposureMatch match({&plan, 1});
  follow(match, 1);
  EXPECT_EQ(match.table(1), nullptr) << "alike";
  deliver(plan, {1, 0.5});
  const auto brightened = [&] {
    std::array<std::uint8_t, 3> pixel{100, 100, 100};
    if (match.table(1))
      match.table(1)->apply<std::uint8_t>({pixel.data(), 1, 1, 3, 3}, PixelFormat::Rgb);
    return pixel[1];
  };
  // An earlier set may still be in progress.
  follow(match, match.comparisons() + 2);
  const int early = brightened();
  follow(match, match.comparisons() + 12);
  const int late = brightened();
  EXPECT_GT(early, 105);
  EXPECT_LT(early, late - 5);
  EXPECT_NEAR(late,
              255 * remap::from_light(remap::Transfer::Srgb,
                                      2 * remap::to_light(remap::Transfer::Srgb, 100 / 255.0)),
              4);
}

TEST_F(ExposureMatchTest, LeavesOthersAlone) {
  const ViewPlan one = room_panorama({source_in_room(0, PixelFormat::Rgb, 0)});
  const ViewPlan mapped = room_panorama(
      {source_in_room(0, PixelFormat::Rgb, 0), source_in_room(1, PixelFormat::Grey, 150)});
  ViewPlan unmatched = room_panorama(
      {source_in_room(0, PixelFormat::Rgb, 0), source_in_room(1, PixelFormat::Rgb, 150)});
  unmatched.match = false;
  for (const ViewPlan* plan : std::array{&one, &mapped, static_cast<const ViewPlan*>(&unmatched)}) {
    deliver(*plan, {1});
    ExposureMatch match({plan, 1});
    for (int i = 0; i < 5; ++i) {
      set.stamp += std::chrono::seconds(1);
      match.follow(set, *pyramids, workers);
    }
    EXPECT_EQ(match.comparisons(), 0U);
    EXPECT_EQ(match.table(0), nullptr);
  }
}

TEST_F(ExposureMatchTest, WaitsForACameraThatDoesNotDeliver) {
  const ViewPlan plan = room_panorama(
      {source_in_room(0, PixelFormat::Rgb, 0), source_in_room(1, PixelFormat::Rgb, 150)});
  deliver(plan, {1, 0.5});
  ExposureMatch match({&plan, 1});
  follow(match, 1);
  set.frames[1] = nullptr;
  pyramids->build(set, {}, workers);
  const auto compared = match.comparisons();
  for (int i = 0; i < 5; ++i) {
    set.stamp += std::chrono::seconds(1);
    match.follow(set, *pyramids, workers);
  }
  EXPECT_NE(match.table(1), nullptr) << "as it was";
  EXPECT_LE(match.comparisons(), compared + 1);
}

}  // namespace
}  // namespace orbwatch::app::pipeline
