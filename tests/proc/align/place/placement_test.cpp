// SPDX-License-Identifier: Apache-2.0
#include "proc/align/place/placement.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "tests/proc/align/place/mirrored_rig.h"

/// Placement of cameras that are simulated by plain vectors.
namespace orbwatch::tests {
namespace {

using align::BallCentre;
using align::place;
using align::PlaceRequest;

constexpr auto kKnown = BallCentre::Knowledge::Known;
constexpr auto kMeasured = BallCentre::Knowledge::Measured;
constexpr auto kUnknown = BallCentre::Knowledge::Unknown;

struct Scene {
  MirroredRig rig;
  PlaceRequest request;
};

/// Marks without an error, but with sigmas.
Scene exact(std::uint64_t seed, const RigWishes& wishes, BallCentre::Knowledge knowledge,
            bool focal_unknown = false) {
  std::mt19937_64 random(seed);
  Scene scene{random_rig(random, wishes), {}};
  scene.request = request_of(scene.rig, {0, 0, 0, 0}, knowledge, focal_unknown, random);
  scene.request.sigma_px = 0.5;
  scene.request.centre.sigma = knowledge == kMeasured ? 1 : 0;
  for (auto& camera : scene.request.cameras) camera.outline_sigma = 0.5;
  return scene;
}

void expect_placed(const Scene& scene, double degrees) {
  const auto placed = place(scene.request);
  ASSERT_TRUE(placed) << placed.error().message;
  for (std::size_t c = 0; c < scene.rig.cameras.size(); ++c) {
    EXPECT_LT(direction_error(scene.rig, c, *placed), degrees);
    const optics::Vec3 off = placed->cameras[c].pose.position - scene.rig.cameras[c].pose.position;
    EXPECT_LT(norm(off), 1e-3 * norm(scene.rig.cameras[c].pose.position - scene.rig.centre));
    for (const auto& mark : placed->cameras[c].marks) EXPECT_FALSE(mark.is_outlier);
  }
  EXPECT_LT(norm(placed->ball_centre - scene.rig.centre), 1e-3 * scene.rig.radius);
  EXPECT_LT(placed->reduced_chi_square, 1e-3);
}

TEST(Placement, IsExactWithoutErrors) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE(seed);
    expect_placed(exact(seed, {1, 6}, kKnown), 1e-3);
    expect_placed(exact(seed, {1, 6}, kMeasured), 1e-3);
    expect_placed(exact(seed, {1, 6}, kUnknown), 1e-3);
    expect_placed(exact(seed, {2, 4}, kUnknown), 1e-3);
    expect_placed(exact(seed, {1, 16}, kKnown, true), 1e-2);
  }
}

TEST(Placement, NeedsNoMoreThanItSays) {
  for (const auto knowledge : {kKnown, kUnknown}) {
    Scene scene = exact(4, {1, 12}, knowledge);
    const std::size_t least = align::least_marks(scene.request);
    EXPECT_EQ(least, knowledge == kKnown ? 2U : 4U);
    auto& marks = scene.request.cameras[0].marks;
    marks.resize(least + 1);
    expect_placed(scene, 1e-3);
    marks.resize(least - 1);
    const auto refused = place(scene.request);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find(std::to_string(least)), std::string::npos)
        << refused.error().message;
  }
}

/// The point beside the ball that is shown nearest to the limb, and where.
std::pair<optics::Vec3, optics::Vec2> nearest_to_limb(const MirroredRig& rig) {
  const RigCamera& camera = rig.cameras[0];
  const optics::Vec3 towards = normalized(camera.pose.position - rig.centre);
  const optics::Vec3 side = normalized(cross(towards, optics::Vec3{0.3, 0.5, 0.8}));
  std::pair<optics::Vec3, optics::Vec2> nearest;
  for (double angle = 90; angle < 180; angle += 0.01) {
    const double a = optics::radians(angle);
    const auto point = rig.centre + (towards * std::cos(a) + side * std::sin(a)) * (8 * rig.radius);
    const optics::Vec2 pixel = seen_at(camera, rig.centre, rig.radius, point);
    if (std::isnan(pixel.u)) break;
    nearest = {point, pixel};
  }
  return nearest;
}

TEST(Placement, UsesAMarkOutsideOfTheOutlineByItsError) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE(seed);
    Scene scene = exact(seed, {1, 8}, kKnown);
    auto& camera = scene.request.cameras[0];
    const auto [point, seen] = nearest_to_limb(scene.rig);
    const optics::Vec2 middle = camera.outline.centre, out{seen.u - middle.u, seen.v - middle.v};
    const double away = std::hypot(out.u, out.v);
    const double limb = away / optics::relative_distance(camera.outline, seen);
    const auto outside = [&](double px) {
      const double scale = (limb + px) / away;
      return optics::Vec2{middle.u + out.u * scale, middle.v + out.v * scale};
    };
    camera.marks.push_back({align::add_point(scene.request, point), outside(0.3)});
    const auto placed = place(scene.request);
    ASSERT_TRUE(placed) << placed.error().message;
    EXPECT_FALSE(placed->cameras[0].marks.back().is_outlier);
    EXPECT_LT(direction_error(scene.rig, 0, *placed), 0.1);
    camera.marks.back().pixel = outside(5);
    const auto refused = place(scene.request);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("px outside of the ball's outline; the sigmas permit"),
              std::string::npos)
        << refused.error().message;
  }
}

TEST(Placement, CamerasThatShareTheBallHelpOneAnother) {
  std::mt19937_64 random(5);
  const MirroredRig rig = random_rig(random, {2, 6});
  PlaceRequest both = request_of(rig, {}, kUnknown, false, random);
  PlaceRequest alone = both;
  alone.cameras.resize(1);
  const auto together = place(both), single = place(alone);
  ASSERT_TRUE(together) << together.error().message;
  ASSERT_TRUE(single) << single.error().message;
  EXPECT_LT(together->cameras[0].direction_sigma, single->cameras[0].direction_sigma);
  EXPECT_LT(cv::trace(together->ball_centre_covariance), cv::trace(single->ball_centre_covariance));
  // The same two solutions for a point that only one of them shows.
  both.cameras[1].marks.pop_back();
  EXPECT_TRUE(place(both));
}

TEST(Placement, NamesAPointThatWasMisclicked) {
  for (const auto knowledge : {kKnown, kUnknown}) {
    for (std::uint64_t seed = 10; seed < 16; ++seed) {
      SCOPED_TRACE(seed);
      std::mt19937_64 random(seed);
      const MirroredRig rig = random_rig(random, {1, 9, 400, 800});
      PlaceRequest request = request_of(rig, {}, knowledge, false, random);
      const std::size_t wrong = seed % 9;
      optics::Vec2& pixel = request.cameras[0].marks[wrong].pixel;
      // The slip is towards the middle, or the mark might leave the ball.
      const optics::Vec2& middle = request.cameras[0].outline.centre;
      const double away = std::hypot(pixel.u - middle.u, pixel.v - middle.v);
      const double slip = seed % 2 == 0 ? 15 : 80;
      pixel = {pixel.u - slip * (pixel.u - middle.u) / away,
               pixel.v - slip * (pixel.v - middle.v) / away};
      const auto placed = place(request);
      ASSERT_TRUE(placed) << placed.error().message;
      for (std::size_t m = 0; m < 9; ++m) {
        EXPECT_EQ(placed->cameras[0].marks[m].is_outlier, m == wrong) << m;
      }
      const auto off = placed->cameras[0].marks[wrong].residual;
      ASSERT_TRUE(off);
      EXPECT_NEAR(std::hypot(off->u, off->v), slip, 6);
      EXPECT_LT(direction_error(rig, 0, *placed), 4 * placed->cameras[0].direction_sigma);
    }
  }
}

/// A ray of a camera, displaced by a window that is traced surface by surface; ball radii.
RealRay through_window(const MirroredRig& rig, const optics::Window& window, const Vec2& pixel) {
  const RigCamera& camera = rig.cameras[0];
  const optics::Mat3& axes = camera.pose.rotation;
  const RealVec3 way =
      normalized(RealVec3(axes.row0 * ((pixel.u - camera.middle().u) / camera.focal) +
                          axes.row1 * ((pixel.v - camera.middle().v) / camera.focal) + axes.row2));
  const Vec3 out = dot(window.normal, axes.row2) > 0 ? window.normal : -window.normal;
  const RealRay left =
      through_glass({{}, way}, RealVec3(normalized(out)), 100, window.thickness, window.index);
  const Vec3 eye = camera.pose.position - rig.centre;
  return {(RealVec3(eye) + left.origin) * (1 / Real(rig.radius)), left.direction};
}

/// The limb behind a window: the places where rays begin to miss the ball, along many radii.
optics::Outline limb_behind(const MirroredRig& rig, const optics::Window& window) {
  const SeenLimb about = limb_of(rig.cameras[0], rig.centre, rig.radius);
  std::vector<cv::Point2f> limb;
  for (int n = 0; n < 90; ++n) {
    const double a = optics::radians(4.0 * n);
    const auto at = [&](double radius) {
      return Vec2{about.centre.u + radius * std::cos(a), about.centre.v + radius * std::sin(a)};
    };
    double low = 0.8 * about.rx, high = 1.2 * about.rx;
    for (int step = 0; step < 40; ++step) {
      const double middle = (low + high) / 2;
      (reflected(through_window(rig, window, at(middle))) ? low : high) = middle;
    }
    // Points are relative to the middle: OpenCV's ellipses are of single precision.
    const Vec2 edge = at(low);
    limb.emplace_back(float(edge.u - about.centre.u), float(edge.v - about.centre.v));
  }
  const cv::RotatedRect fitted = cv::fitEllipse(limb);
  return {{double(fitted.center.x) + about.centre.u, double(fitted.center.y) + about.centre.v},
          double(fitted.size.width) / 2,
          double(fitted.size.height) / 2,
          double(fitted.angle)};
}

TEST(Placement, SeesThroughAWindow) {
  Scene scene = exact(25, {1, 10}, kKnown);
  const MirroredRig& rig = scene.rig;
  std::mt19937_64 random(25);
  std::uniform_real_distribution<double> in(-1, 1);
  const optics::Mat3& axes = rig.cameras[0].pose.rotation;
  const optics::Window window{axes.row2 + axes.row0 * 0.3, 12, 1.52};
  auto& camera = scene.request.cameras[0];
  camera.outline = limb_behind(rig, window);
  for (std::size_t p = 0; p < camera.marks.size(); ++p) {
    // Any pixel well within the limb, and a point on its ray.
    const double u = in(random), v = in(random), scale = 0.6 * camera.outline.rx;
    camera.marks[p].pixel = {camera.outline.centre.u + u * scale,
                             camera.outline.centre.v + v * scale};
    const auto out = reflected(through_window(rig, window, camera.marks[p].pixel));
    ASSERT_TRUE(out);
    const Vec3 at = rounded(out->origin + out->direction * Real(6 + 4 * in(random)));
    scene.request.points[p] = rig.centre + at * rig.radius;
  }
  const auto off = [&] {
    const auto placed = place(scene.request);
    EXPECT_TRUE(placed) << placed.error().message;
    return placed ? norm(placed->cameras[0].pose.position - rig.cameras[0].pose.position) : 0;
  };
  EXPECT_GT(off(), 2) << "without the window";
  camera.window = window;
  EXPECT_LT(off(), 0.05);
}

TEST(Placement, RefusesMarksThatContradictOneAnother) {
  std::mt19937_64 random(20);
  PlaceRequest request =
      request_of(random_rig(random, {1, 6, 400, 800}), {}, kUnknown, false, random);
  // Two points are interchanged, like in a list with a wrong line.
  request.cameras[0].marks.resize(4);
  std::swap(request.cameras[0].marks[0].point, request.cameras[0].marks[1].point);
  const auto refused = place(request);
  ASSERT_FALSE(refused);
}

TEST(Placement, RefusesAWrongRadiusOfTheBall) {
  Scene scene = exact(21, {1, 12, 600, 900}, kKnown);
  scene.request.ball_radius *= 1.15;
  EXPECT_FALSE(place(scene.request));
}

struct Flaw {
  std::string name;
  std::function<void(Scene&)> make;
  std::string says;
};

TEST(Placement, RefusesFlawsWithTheReason) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Flaw> flaws{
      {"no camera", [](Scene& s) { s.request.cameras.clear(); }, "no camera"},
      {"one point", [](Scene& s) { s.request.cameras[0].marks.resize(1); },
       "camera A has 1 marked points; 2 are needed"},
      {"one point, many times",
       [](Scene& s) {
         auto& marks = s.request.cameras[0].marks;
         marks.assign(6, marks[0]);
       },
       "1 marked points"},
      {"all in one direction",
       [](Scene& s) {
         const optics::Vec3 way = s.request.points[0] - s.rig.centre;
         auto& marks = s.request.cameras[0].marks;
         for (std::size_t p = 0; p < marks.size(); ++p) {
           s.request.points[p] = s.rig.centre + way * (1.0 + 1e-9 * double(p));
           marks[p].pixel = marks[0].pixel;
         }
       },
       "other directions"},
      {"a point within the ball",
       [](Scene& s) {
         s.request.points[2] = s.rig.centre + optics::Vec3{0, 0, 0.9 * s.rig.radius};
       },
       "point 3 ("},
      {"a point behind the ball",
       [](Scene& s) {
         const optics::Vec3 away = s.rig.centre - s.rig.cameras[0].pose.position;
         s.request.points[1] = s.rig.centre + away * 0.5;
         s.request.sigma_px = 200;
       },
       "point 2 ("},
      {"a point that is no number", [](Scene& s) { s.request.points[3].x = kNaN; }, "point 4"},
      {"a pixel that is no number", [](Scene& s) { s.request.cameras[0].marks[0].pixel.v = kNaN; },
       "point 1 ("},
      {"a mark beside the ball", [](Scene& s) { s.request.cameras[0].marks[0].pixel.u += 3000; },
       "outside of the ball's outline"},
      {"a point that there is not", [](Scene& s) { s.request.cameras[0].marks[0].point = 99; },
       "marks point 100; there are 8"},
      {"no sigma", [](Scene& s) { s.request.sigma_px = 0; }, "sigma of marks"},
      {"a sigma of no number", [](Scene& s) { s.request.sigma_mm = kNaN; }, "sigma of points"},
      {"no sigma of the outline", [](Scene& s) { s.request.cameras[0].outline_sigma = 0; },
       "sigma of the outline"},
      {"no ball", [](Scene& s) { s.request.ball_radius = kNaN; }, "radius"},
      {"a centre that is no number", [](Scene& s) { s.request.centre.position.x = kNaN; }, "ball"},
      {"no lens", [](Scene& s) { s.request.cameras[0].lens.fx = 0; }, "focal lengths"},
      {"no outline", [](Scene& s) { s.request.cameras[0].outline.rx = -1; }, "radius"},
      {"a long lens for two near points",
       [](Scene& s) {
         s.request.cameras[0].focal_unknown = true;
         s.request.cameras[0].marks.resize(3);
         s.request.sigma_px = 5;
       },
       "focal length"},
  };
  for (const Flaw& flaw : flaws) {
    SCOPED_TRACE(flaw.name);
    Scene scene = exact(30, {1, 8}, kKnown);
    flaw.make(scene);
    const auto refused = place(scene.request);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find(flaw.says), std::string::npos)
        << refused.error().message;
  }
}

}  // namespace
}  // namespace orbwatch::tests
