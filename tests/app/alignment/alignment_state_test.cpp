// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/alignment_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "proc/align/register/registration.h"
#include "tests/app/alignment/rig_with_pose.h"

namespace orbwatch::app {
namespace {

optics::Rig posed_rig() { return tests::rig_with_pose({120, -540, 430}); }

TEST(AlignmentState, OfAPoseIsItsOutlineAndItsRotation) {
  const optics::Rig rig = posed_rig();
  const auto state = alignment_state(rig, rig.cameras.front());
  ASSERT_TRUE(state) << state.error().message;
  EXPECT_NEAR(state->outline.centre.u, 399.5, 1e-6);
  EXPECT_NEAR(state->outline.rx, 4200 * std::tan(std::asin(50.0 / 600)), 1e-6);
  ASSERT_TRUE(state->position);
  EXPECT_NEAR(norm(*state->position - optics::Vec3{120, -540, 430}), 0, 1e-6);
  // It looks along +Y, so that yaw 180 looks back at it.
  EXPECT_NEAR(std::abs(state->rotation.yaw), 180, 1e-6);
  EXPECT_NEAR(state->rotation.pitch, 0, 1e-6);
  EXPECT_TRUE(state->edges.empty()) << "there is no scene";
}

TEST(AlignmentState, IsTheSameForACameraThatIsStatedByItsOutline) {
  const optics::Rig rig = posed_rig();
  const auto turnable = align::by_outline(rig, rig.cameras.front());
  ASSERT_TRUE(turnable);
  const auto state = alignment_state(rig, *turnable);
  ASSERT_TRUE(state);
  ASSERT_TRUE(state->position);
  EXPECT_NEAR(norm(*state->position - optics::Vec3{120, -540, 430}), 0, 1e-3);
}

TEST(AlignmentState, EdgesOfTheSceneAreWhereTheBallShowsThem) {
  optics::Rig rig = posed_rig();
  rig.scene.room = optics::Scene::Room::Box;
  rig.scene.walls = {{-600, -900, 0}, {600, 500, 800}};
  const auto state = alignment_state(rig, rig.cameras.front());
  ASSERT_TRUE(state) << state.error().message;
  const auto ball = optics::ball_projection(rig, rig.cameras.front());
  ASSERT_TRUE(ball);
  // A corner at the camera's side, where three edges meet.
  const auto corner = ball->pixel(normalized(optics::Vec3{-600, -900, 0} - rig.ball.centre));
  ASSERT_TRUE(corner);
  int ends = 0;
  for (const SceneEdge& edge : state->edges) {
    ASSERT_GT(edge.pixels.size(), 1U);
    for (const auto& [pixel, point] :
         {std::pair(edge.pixels.front(), edge.from), std::pair(edge.pixels.back(), edge.to)}) {
      const bool is_there = std::hypot(pixel.u - corner->u, pixel.v - corner->v) < 1e-3;
      ends += is_there ? 1 : 0;
      const bool is_meant = norm(point + rig.ball.centre - optics::Vec3{-600, -900, 0}) < 1e-9;
      EXPECT_EQ(is_there, is_meant);
    }
  }
  EXPECT_EQ(ends, 3);
}

TEST(AlignmentState, OffersEachVisibleCornerOnce) {
  optics::Rig rig = posed_rig();
  rig.scene.room = optics::Scene::Room::Box;
  rig.scene.walls = {{-600, -900, 0}, {600, 500, 800}};
  rig.scene.obstacles = {{{-100, -200, 50}, {340, 320, 200}}};
  const auto state = alignment_state(rig, rig.cameras.front());
  const auto ball = optics::ball_projection(rig, rig.cameras.front());
  ASSERT_TRUE(state && ball);
  int of_top = 0, of_room = 0;
  for (const SceneCorner& corner : state->corners) {
    const optics::Vec3& p = corner.point;
    EXPECT_EQ(std::ranges::count_if(state->corners,
                                    [&](const auto& other) { return norm(other.point - p) < 1; }),
              1);
    of_top += std::abs(p.z - 200) < 1e-6 ? 1 : 0;
    of_room += std::abs(std::abs(p.x) - 600) < 1e-6 ? 1 : 0;
    const auto pixel = ball->pixel(normalized(p - rig.ball.centre));
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(std::hypot(pixel->u - corner.pixel.u, pixel->v - corner.pixel.v), 0, 1e-3);
  }
  EXPECT_EQ(of_top, 4) << "and none of its bottom, which it hides";
  EXPECT_GE(of_room, 6) << "but for those in the blind cone";
  EXPECT_EQ(state->corners.size(), static_cast<std::size_t>(of_top + of_room));
}

/// From above nothing of the floor below the table is seen.
TEST(AlignmentState, WhatIsHiddenIsNotShown) {
  optics::Rig rig = posed_rig();
  rig.scene.obstacles = {{{-100, -200, 0}, {340, 320, 200}}};
  const auto state = alignment_state(rig, rig.cameras.front());
  ASSERT_TRUE(state) << state.error().message;
  EXPECT_EQ(state->edges.size(), 4U) << "of the top; the ball hangs above it";
}

}  // namespace
}  // namespace orbwatch::app
