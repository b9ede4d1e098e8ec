// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/pan_tilt_zoom.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <limits>
#include <memory>
#include <string>
#include <thread>

#include "tests/app/pipeline/views/pointed_views.h"

namespace orbwatch::app::pipeline {
namespace {

/// Fixture without a pipeline: the test exchanges renderers itself. The right view is large: its
/// compilation takes long, the left one's does not.
class PanTiltZoomTest : public testing::Test {
 protected:
  static constexpr Pointing kAside{{30, 0, 0}, 80, std::nullopt};

  std::uint64_t point(std::size_t view) { return pan_tilt_zoom.point(view, kAside).value(); }

  template <class Condition>
  void wait_until(Condition condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!condition() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    ASSERT_TRUE(condition());
  }
  void exchange() {
    for (std::size_t view = 0; view < shown.size(); ++view) {
      pan_tilt_zoom.exchange(view, shown[view]);
    }
  }
  std::uint64_t pointing(std::size_t view) const {
    return shown[view] ? shown[view]->plan().pointing : 0;
  }
  void exchange_until(std::size_t view, std::uint64_t number) {
    wait_until([&] {
      exchange();
      return pointing(view) >= number;
    });
  }

  std::string refusal(std::size_t view, const Pointing& pointing) {
    const auto number = pan_tilt_zoom.point(view, pointing);
    return number ? "none, but number " + std::to_string(*number) : number.error().message;
  }

  std::array<ViewPlan, 2> plans = two_views();
  PanTiltZoom pan_tilt_zoom{plans};
  std::array<std::unique_ptr<ViewRenderer>, 2> shown;

 private:
  static std::array<ViewPlan, 2> two_views() {
    std::array plans{view_plan(kLeft, optics::ViewKind::Perspective, kHome),
                     view_plan(kRight, optics::ViewKind::Perspective, kHome)};
    plans[kRight].projection =
        optics::ViewProjection::make({optics::ViewKind::Perspective, {}, 100, {}, 640, 480})
            .value();
    return plans;
  }
};

TEST_F(PanTiltZoomTest, CountsWhatWasCompiledForNothingToo) {
  point(kLeft);
  std::uint64_t number = 0;
  do {
    number = point(kLeft);
  } while (pan_tilt_zoom.superseded(kLeft) == number - 1);
  // The request before the last is or was being compiled, and no exchange applies it.
  wait_until([&] { return pan_tilt_zoom.superseded(kLeft) == number - 1; });
  exchange_until(kLeft, number);
  EXPECT_EQ(pan_tilt_zoom.superseded(kLeft), number - 1);
  EXPECT_EQ(pan_tilt_zoom.superseded(kRight), 0U);
}

TEST_F(PanTiltZoomTest, TheViewsTakeTurns) {
  for (int i = 0; i < 5; ++i) {
    exchange_until(kLeft, point(kLeft));
    const std::uint64_t right = point(kRight), left = point(kLeft);
    exchange_until(kLeft, left);
    ASSERT_EQ(pointing(kRight), right) << "asked for before the left view's next";
  }
}

TEST_F(PanTiltZoomTest, LeavesWhatNobodyPointed) {
  exchange_until(kLeft, point(kLeft));
  EXPECT_EQ(shown[kRight], nullptr);
  const ViewRenderer* const before = shown[kLeft].get();
  exchange();
  EXPECT_EQ(shown[kLeft].get(), before);
}

TEST_F(PanTiltZoomTest, RefusesWithAReason) {
  EXPECT_EQ(refusal(2, kHome), "view 2: cannot be pointed; there are 2, from 0");
  EXPECT_EQ(refusal(kLeft, {{}, 180, {}}),
            "view left: the view's h_fov is 180.000000 degrees; it must be above 0 "
            "and below 180");
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const Pointing& bad : {Pointing{{}, 0, {}}, Pointing{{}, -1, {}}, Pointing{{}, kNan, {}},
                              Pointing{{}, 90, kInfinity}, Pointing{{kNan, 0, 0}, 90, {}},
                              Pointing{{0, kInfinity, 0}, 90, {}}}) {
    EXPECT_FALSE(pan_tilt_zoom.point(kLeft, bad));
  }
  EXPECT_EQ(refusal(kLeft, {{30, 0, 0}, 90, {}}), "none, but number 1")
      << "refusals are not numbered";
}

TEST_F(PanTiltZoomTest, RefusesEverythingOnceItStopped) {
  point(kLeft);
  pan_tilt_zoom.stop();
  EXPECT_EQ(refusal(kLeft, kHome),
            "view left: cannot be pointed any more; the pipeline has stopped");
  pan_tilt_zoom.stop();
}

TEST(PanTiltZoom, ABallsOwnPictureIsNotPointed) {
  ViewPlan plan = view_plan(kLeft, optics::ViewKind::Perspective, kHome);
  plan.projection =
      optics::ViewProjection::make({optics::ViewKind::Ball, {}, {}, {}, 48, 48}, ball()).value();
  PanTiltZoom pan_tilt_zoom({&plan, 1});
  const auto number = pan_tilt_zoom.point(0, kHome);
  ASSERT_FALSE(number);
  EXPECT_EQ(number.error().message,
            "view left: a ball's own picture takes no yaw, "
            "pitch, roll, h_fov or v_fov");
}

}  // namespace
}  // namespace orbwatch::app::pipeline
