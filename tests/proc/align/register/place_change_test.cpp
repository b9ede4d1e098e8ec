// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/place_change.h"

#include <gtest/gtest.h>

#include <cmath>

#include "proc/align/register/spiral.h"
#include "proc/align/rotation_fit.h"

namespace orbwatch::align {
namespace {

using optics::Outline;
using optics::Vec3;

/// A camera at 12 radii of a ball in a spherical room of `radius` ball radii, or far from
/// everything.
SoughtCamera camera_in_room(double radius) {
  SoughtCamera sought;
  sought.rig.ball = {{}, 1};
  if (radius > 0) {
    sought.rig.scene.room = optics::Scene::Room::Sphere;
    sought.rig.scene.radius = radius;
  }
  sought.camera.name = "B";
  sought.camera.width = 320;
  sought.camera.height = 256;
  sought.camera.distance = 12;
  sought.camera.outline = Outline{{160, 128}, 100, 100, 0};
  return sought;
}

/// The pixel of the changed camera is that of the shifted direction in the unchanged one.
TEST(PlaceShifts, PredictWhereAChangedCameraShowsAThing) {
  const Place place{rotation_about({0.3, -0.2, 1}), {{160, 128}, 100, 100, 0}};
  for (const double radius : {0.0, 8.0}) {
    const SoughtCamera sought = camera_in_room(radius);
    const auto shifts = PlaceShifts::make(sought, place);
    ASSERT_TRUE(shifts) << shifts.error().message;
    const PlaceChange by{1e-3, -2e-3, 5e-4, 2e-3, -1e-3, 1e-3};
    const Place moved = changed(place, by);
    const auto ball = turned(sought, moved.rotation, moved.outline);
    ASSERT_TRUE(ball) << ball.error().message;
    int checked = 0;
    for (int n = 0; n < 200; ++n) {
      const Vec3 direction = spiral(n, 200);
      const auto shift = shifts->at(direction);
      if (!shift || dot(direction, shifts->ball().facing()) < -0.7) continue;
      Vec3 from = direction;
      for (int k = 0; k < kPlaceUnknowns; ++k) {
        from = from + (*shift)[static_cast<std::size_t>(k)] * by[k];
      }
      const auto expected = ball->pixel(direction);
      const auto shown = shifts->ball().pixel(optics::normalized(from));
      ASSERT_TRUE(expected && shown);
      EXPECT_LT(std::hypot(expected->u - shown->u, expected->v - shown->v), 2e-3);
      ++checked;
    }
    EXPECT_GT(checked, 150);
  }
}

TEST(PlaceChange, OfAnOutlineLeadsFromOneToTheOther) {
  const Place from{{}, {{160, 128}, 100, 100, 0}};
  const Outline to{{160.4, 127.7}, 100.5, 100.5, 0};
  const Outline reached = changed(from, outline_change(from.outline, to)).outline;
  EXPECT_NEAR(reached.centre.u, to.centre.u, 1e-9);
  EXPECT_NEAR(reached.centre.v, to.centre.v, 1e-9);
  EXPECT_NEAR(reached.rx, to.rx, 1e-9);
}

}  // namespace
}  // namespace orbwatch::align
