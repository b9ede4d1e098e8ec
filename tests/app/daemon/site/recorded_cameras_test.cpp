// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/recorded_cameras.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/daemon/site/site_plan.h"
#include "tests/app/daemon/demo_site.h"

namespace orbwatch::app::daemon {
namespace {

optics::Outline limb(const files::Resolved& site, std::size_t camera) {
  const auto ball = optics::ball_projection(site.rig, site.rig_camera(camera));
  EXPECT_TRUE(ball);
  const auto outline = ball->outline();
  EXPECT_TRUE(outline);
  return outline.value_or(optics::Outline{});
}

TEST(RecordedCameras, TheirPartHasTheWholeLimbAndLittleElse) {
  const files::Resolved site = demo();
  const auto cameras = recorded_cameras(site, expected_formats(site));
  ASSERT_EQ(cameras.size(), site.site.cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    EXPECT_EQ(cameras[i].name, site.site.cameras[i].name);
    const auto& [x, y, width, height] = cameras[i].ball;
    const optics::Outline ball = limb(site, i);
    EXPECT_GE(x, 0);
    EXPECT_LE(x + width, cameras[i].format.width);
    for (int degree = 0; degree < 360; ++degree) {
      const double t = degree * std::numbers::pi / 180, turn = ball.angle * std::numbers::pi / 180;
      const double a = ball.rx * std::cos(t), b = ball.ry * std::sin(t);
      const double u = ball.centre.u + a * std::cos(turn) - b * std::sin(turn);
      const double v = ball.centre.v + a * std::sin(turn) + b * std::cos(turn);
      if (u < 0 || v < 0 || u > cameras[i].format.width - 1 || v > cameras[i].format.height - 1) {
        continue;
      }
      EXPECT_GE(u, x);
      EXPECT_LE(u, x + width - 1);
      EXPECT_GE(v, y);
      EXPECT_LE(v, y + height - 1);
    }
    EXPECT_LE(width, 2 * 1.1 * std::max(ball.rx, ball.ry) + 2);
  }
}

TEST(RecordedCameras, APictureOfAnotherSizeIsRecordedWhole) {
  const files::Resolved site = demo();
  auto formats = expected_formats(site);
  formats[0].width *= 2;
  const auto cameras = recorded_cameras(site, formats);
  EXPECT_EQ(cameras[0].ball,
            (hal::recording::PictureRegion{0, 0, formats[0].width, formats[0].height}));
}

}  // namespace
}  // namespace orbwatch::app::daemon
