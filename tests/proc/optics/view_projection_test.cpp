#include "proc/optics/view_projection.h"

#include <gtest/gtest.h>

#include <numbers>

#include "proc/optics/angle.h"

namespace orbwatch::optics {
namespace {

ViewSpec perspective(double yaw, double pitch, double roll, double h_fov) {
  return {ViewKind::Perspective, {yaw, pitch, roll}, h_fov, {}, 641, 481};
}

double deviation(const Vec3& a, const Vec3& b) { return degrees(angle_between(a, b)); }

TEST(ViewProjection, PerspectiveSpansEdgeToEdge) {
  const auto view = ViewProjection::make(perspective(0, 0, 0, 90)).value();
  EXPECT_LT(deviation(view.direction(320, 240), {0, 1, 0}), 1e-9);
  EXPECT_LT(deviation(view.direction(640.5, 240), {1, 1, 0}), 1e-9);  // +X is on the right
  EXPECT_GT(view.direction(320, 0).z, 0);
}

TEST(ViewProjection, TurnsByYawPitchRoll) {
  const auto view = ViewProjection::make(perspective(90, 0, 0, 60)).value();
  EXPECT_LT(deviation(view.direction(320, 240), {1, 0, 0}), 1e-9);
  const auto up = ViewProjection::make(perspective(0, 30, 0, 60)).value();
  EXPECT_NEAR(up.direction(320, 240).z, 0.5, 1e-12);
  const auto rolled = ViewProjection::make(perspective(0, 0, 10, 90)).value();
  EXPECT_LT(rolled.direction(640, 240).z, 0);  // its right side dips
}

TEST(ViewProjection, EquirectangularIsLinearInLongitudeAndLatitude) {
  const auto view = ViewProjection::make({ViewKind::Equirectangular, {}, {}, {}, 360, 180}).value();
  for (const auto& [lon, lat] : {std::pair{0.0, 0.0}, {90.0, 0.0}, {-120.0, 45.0}, {10.0, -80.0}}) {
    const Vec3 truth{std::cos(radians(lat)) * std::sin(radians(lon)),
                     std::cos(radians(lat)) * std::cos(radians(lon)), std::sin(radians(lat))};
    EXPECT_LT(deviation(view.direction(lon + 179.5, 89.5 - lat), truth), 1e-9);
  }
}

TEST(ViewProjection, SolidAnglesAddUp) {
  const auto sum = [](const ViewSpec& spec) {
    const auto view = ViewProjection::make(spec).value();
    double total = 0;
    for (int v = 0; v < spec.height; ++v) {
      for (int u = 0; u < spec.width; ++u) total += view.solid_angle(u, v);
    }
    return total;
  };
  EXPECT_NEAR(sum({ViewKind::Equirectangular, {}, {}, {}, 512, 256}), 4 * std::numbers::pi, 1e-3);
  // A square view of 90 degrees is one of a cube's six faces.
  EXPECT_NEAR(sum({ViewKind::Perspective, {}, 90, {}, 400, 400}), 4 * std::numbers::pi / 6, 1e-3);
}

TEST(ViewProjection, RefusesImpossibleViews) {
  const double nan = std::nan("");
  const auto refused = [](const ViewSpec& spec) { return !ViewProjection::make(spec).has_value(); };
  EXPECT_TRUE(refused({ViewKind::Perspective, {}, {}, {}, 0, 10}));
  EXPECT_TRUE(refused({ViewKind::Perspective, {}, {}, {}, 10, 16385}));
  EXPECT_TRUE(refused(perspective(nan, 0, 0, 90)));
  for (const double h_fov : {0.0, -1.0, 180.0, 360.0, nan}) {
    EXPECT_TRUE(refused(perspective(0, 0, 0, h_fov))) << h_fov;
  }
  EXPECT_TRUE(refused({ViewKind::Equirectangular, {}, 361, {}, 10, 10}));
  EXPECT_FALSE(refused({ViewKind::Equirectangular, {}, 360, 180, 10, 10}));
  EXPECT_FALSE(refused({ViewKind::Perspective, {}, 179, {}, 1, 1}));
}

}  // namespace
}  // namespace orbwatch::optics
