// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/merge/blend_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numeric>

#include "proc/optics/resolution.h"
#include "proc/optics/rotation.h"
#include "proc/remap/merge/merge.h"

namespace orbwatch::remap {
namespace {

using optics::BallModel;
using optics::BallProjection;
using optics::ViewKind;
using optics::ViewProjection;

/// A view and cameras around one ball.
class BlendGridTest : public testing::Test {
 protected:
  /// Adds a camera that was turned `yaw` degrees around the ball and has this limb in its picture.
  void add(double yaw, const optics::Outline& limb, int side, double weight = 1) {
    cameras.push_back(std::make_unique<Camera>(
        BallProjection::make(BallModel::make(BallModel::Kind::Exact, 345).value(), limb,
                             optics::rotation({yaw, 0, 0}))
            .value(),
        view, side, weight));
  }
  void add(double yaw, double weight = 1) { add(yaw, {{199.5, 199.5}, 180, 180, 0}, 400, weight); }

  void compile() {
    std::vector<BlendSource> sources;
    for (const auto& c : cameras) {
      sources.push_back(
          {c->ball, c->grid.source_width(), c->grid.source_height(), c->weight, enough});
    }
    const BlendGrid blend(view, sources);
    planes.assign(cameras.size(), std::vector<std::uint8_t>(static_cast<std::size_t>(view.width()) *
                                                            view.height()));
    for (std::size_t n = 0; n < cameras.size(); ++n) {
      blend.weights(n, cameras[n]->grid,
                    {planes[n].data(), view.width(), view.height(), 1, view.width()});
    }
  }
  int at(std::size_t n, int x, int y) const {
    return planes[n][static_cast<std::size_t>(y) * view.width() + x];
  }
  /// The share of source `n` at the place that shows a direction, degrees.
  int towards(std::size_t n, double lon, double lat) const {
    return at(n, static_cast<int>((lon / 360 + 0.5) * view.width()),
              static_cast<int>((0.5 - lat / 180) * view.height()));
  }
  bool sees(std::size_t n, int x, int y) const {
    std::vector<std::uint8_t>& v = cameras[n]->validity;
    return v[static_cast<std::size_t>(y) * view.width() + x] ==
           static_cast<std::uint8_t>(Validity::Seen);
  }
  int steepest(std::size_t n) const {
    int most = 0;
    for (int y = 1; y < view.height(); ++y) {
      for (int x = 1; x < view.width(); ++x) {
        most = std::max({most, std::abs(at(n, x, y) - at(n, x - 1, y)),
                         std::abs(at(n, x, y) - at(n, x, y - 1))});
      }
    }
    return most;
  }

  struct Camera {
    Camera(const BallProjection& projection, const ViewProjection& view, int side, double users)
        : ball(projection), grid(view, ball, side, side), weight(users) {
      validity.resize(static_cast<std::size_t>(view.width()) * view.height());
      grid.write_validity({validity.data(), view.width(), view.height(), 1, view.width()});
    }
    BallProjection ball;
    CoordinateGrid grid;
    double weight;
    std::vector<std::uint8_t> validity;
  };

  ViewProjection view =
      ViewProjection::make({ViewKind::Equirectangular, {}, {}, {}, 1500, 750}).value();
  std::optional<double> enough;
  std::vector<std::unique_ptr<Camera>> cameras;
  std::vector<std::vector<std::uint8_t>> planes;
};

TEST_F(BlendGridTest, FollowTheFourthPowerOfTheResolution) {
  add(0);
  add(140);
  compile();
  int compared = 0;
  for (int y = 0; y < view.height(); y += 7) {
    for (int x = 0; x < view.width(); x += 7) {
      const auto direction = view.direction(x, y).value();
      const double a = std::pow(optics::resolution(cameras[0]->ball, direction), 4);
      const double b = std::pow(optics::resolution(cameras[1]->ball, direction), 4);
      if (!sees(0, x, y) || !sees(1, x, y)) continue;
      ++compared;
      EXPECT_NEAR(at(0, x, y), 255 * a / (a + b), 3) << x << " " << y;
    }
  }
  EXPECT_GT(compared, 10000);
}

TEST_F(BlendGridTest, AreZeroExactlyWhereASourceSeesNothing) {
  add(0);
  add(100, {{399.5, 20}, 300, 300, 0}, 400);  // cut by the picture's border
  compile();
  int blind = 0;
  for (int y = 0; y < view.height(); ++y) {
    for (int x = 0; x < view.width(); ++x) {
      int total = 0;
      for (const std::size_t n : {0U, 1U}) {
        ASSERT_EQ(at(n, x, y) > 0, sees(n, x, y)) << x << " " << y;
        total += at(n, x, y);
        blind += at(n, x, y) == 0;
      }
      ASSERT_LE(total, 257) << x << " " << y;
    }
  }
  EXPECT_GT(blind, 10000);
}

TEST_F(BlendGridTest, ASourceAloneCountsWhole) {
  add(0, 0.001);
  compile();
  EXPECT_EQ(towards(0, 10, 5), 255);
  EXPECT_EQ(towards(0, 170, 5), 255);
  EXPECT_EQ(towards(0, 179.9, 0), 0) << "blind";
}

TEST_F(BlendGridTest, KeepTheUsersProportionWhereResolutionIsEqual) {
  add(-60, 3);
  add(60, 1);
  compile();
  // The direction of the pixel beside the middle has yaw 0.36 degrees.
  EXPECT_NEAR(towards(0, 0, 0) / double(towards(1, 0, 0)), 3, 0.1);
  EXPECT_NEAR(towards(0, 0, 60) / double(towards(1, 0, 60)), 3, 0.1);
}

TEST_F(BlendGridTest, AreTheUsersWhereEverySourceSeesWellEnough) {
  enough = 0.2;
  add(0, 3);
  add(180, {{99.5, 99.5}, 90, 90, 0}, 200, 1);
  compile();
  for (const double lon : {-120.0, -60.0, 0.0, 60.0, 120.0}) {
    const auto direction = view.direction((lon / 360 + 0.5) * view.width(), 40).value();
    ASSERT_GT(optics::resolution(cameras[0]->ball, direction), 0.3) << lon;
    ASSERT_GT(optics::resolution(cameras[1]->ball, direction), 0.3) << lon;
    const int y = 40;
    const int x = static_cast<int>((lon / 360 + 0.5) * view.width());
    EXPECT_NEAR(at(0, x, y), 191, 1) << lon;
    EXPECT_NEAR(at(1, x, y), 64, 1) << lon;
  }
  // A source still fades out towards its blind cone.
  EXPECT_EQ(towards(0, 176, 0), 255 - towards(1, 176, 0));
  EXPECT_LT(towards(0, 171, 0), 40);
}

TEST_F(BlendGridTest, TheSharperCameraDominates) {
  add(0);
  add(0, {{99.5, 99.5}, 90, 90, 0}, 200);
  compile();
  for (const double lon : {-120, -20, 0, 80}) {
    EXPECT_NEAR(towards(0, lon, 10), 255 * 16 / 17.0, 1) << lon;
    EXPECT_NEAR(towards(1, lon, 10), 255 * 1 / 17.0, 1) << lon;
  }
}

TEST_F(BlendGridTest, NothingBeginsOrEndsSuddenly) {
  add(0);
  add(180);
  add(75, {{300, 199.5}, 180, 180, 0}, 400);  // its right side is cut off
  compile();
  for (const std::size_t n : {0U, 1U, 2U}) EXPECT_LE(steepest(n), 12) << n;
  int cut = 0;
  for (int y = 1; y < view.height(); ++y) {
    for (int x = 1; x < view.width(); ++x) {
      for (const std::size_t n : {0U, 1U, 2U}) {
        if (sees(n, x, y) == sees(n, x - 1, y)) continue;
        ++cut;
        EXPECT_LE(std::max(at(n, x, y), at(n, x - 1, y)), 4) << n << ": " << x << " " << y;
      }
    }
  }
  EXPECT_GT(cut, 100);
}

}  // namespace
}  // namespace orbwatch::remap
