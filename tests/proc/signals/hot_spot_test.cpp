#include "proc/signals/hot_spot.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <vector>

#include "proc/image/validity.h"
#include "proc/optics/angle.h"
#include "proc/signals/measure.h"

namespace orbwatch::signals {
namespace {

using optics::Vec3;
using optics::ViewKind;
using optics::ViewProjection;

/// A view with a measured plane that tests paint.
struct Scene {
  explicit Scene(const optics::ViewSpec& spec)
      : view(ViewProjection::make(spec).value()),
        values(static_cast<std::size_t>(spec.width) * spec.height, 100),
        validity(values.size(), static_cast<std::uint8_t>(Validity::Seen)),
        detector(view) {}

  /// A disc of angular radius `radius` (radians) around `centre`.
  void paint(const Vec3& centre, double radius, std::uint16_t value) {
    for (int y = 0; y < view.height(); ++y) {
      for (int x = 0; x < view.width(); ++x) {
        if (optics::angle_between(*view.direction(x, y), centre) < radius) at(x, y) = value;
      }
    }
  }
  std::uint16_t& at(int x, int y) { return values[static_cast<std::size_t>(y) * view.width() + x]; }
  HotSpot measure(double threshold) {
    const int w = view.width(), h = view.height();
    return detector.measure(ImageView<const std::uint16_t>{values.data(), w, h, 1, w},
                            ImageView<const std::uint8_t>{validity.data(), w, h, 1, w}, threshold);
  }

  ViewProjection view;
  std::vector<std::uint16_t> values;
  std::vector<std::uint8_t> validity;
  HotSpotDetector detector;
};

const optics::ViewSpec kPerspective{ViewKind::Perspective, {30, -10, 5}, 90, {}, 400, 300};
const optics::ViewSpec kPanorama{ViewKind::Equirectangular, {}, {}, {}, 720, 360};

TEST(HotSpot, AreaAndDirectionOfADiscAreThoseOfTheSphere) {
  for (const auto& spec : {kPerspective, kPanorama}) {
    Scene scene(spec);
    const Vec3 centre = scene.view.direction(spec.width * 0.7, spec.height * 0.3).value();
    scene.paint(centre, 0.1, 5000);
    const HotSpot spot = scene.measure(1000);
    ASSERT_TRUE(spot.present);
    EXPECT_NEAR(spot.solid_angle, 2 * std::numbers::pi * (1 - std::cos(0.1)), 0.0005);
    EXPECT_LT(optics::degrees(optics::angle_between(spot.direction, centre)), 0.1);
    EXPECT_EQ(spot.peak, 5000);
    EXPECT_NEAR(spot.mean, 5000, 1e-6);
  }
}

TEST(HotSpot, TheLargestRegionWinsNotTheBrightest) {
  Scene scene(kPerspective);
  const Vec3 pool = *scene.view.direction(100, 200), spark = *scene.view.direction(300, 50);
  scene.paint(pool, 0.08, 3000);
  scene.paint(spark, 0.02, 60000);
  const HotSpot spot = scene.measure(1000);
  EXPECT_EQ(spot.peak, 3000);
  EXPECT_LT(optics::angle_between(spot.direction, pool), 0.01);
}

TEST(HotSpot, JoinsWhatTouchesInAnyShape) {
  Scene scene({ViewKind::Perspective, {}, 40, {}, 60, 40});
  // A U, a diagonal step and a separate pixel: 3 strokes of one region.
  for (int y = 5; y < 20; ++y) scene.at(10, y) = scene.at(20, y) = 2000;
  for (int x = 10; x <= 20; ++x) scene.at(x, 20) = 2000;
  scene.at(21, 21) = 4000;
  scene.at(50, 30) = 9000;
  const HotSpot spot = scene.measure(1500);
  EXPECT_EQ(spot.peak, 4000);
  double area = 0;
  for (int y = 5; y < 20; ++y)
    area += scene.view.solid_angle(10, y) + scene.view.solid_angle(20, y);
  for (int x = 10; x <= 20; ++x) area += scene.view.solid_angle(x, 20);
  area += scene.view.solid_angle(21, 21);
  EXPECT_NEAR(spot.solid_angle, area, 1e-6);
}

TEST(HotSpot, EqualsAFloodFillOnRandomPictures) {
  Scene scene({ViewKind::Perspective, {}, 60, {}, 47, 33});
  std::mt19937 random(6);
  for (int round = 0; round < 200; ++round) {
    for (auto& v : scene.values) v = static_cast<std::uint16_t>(random() % 100);
    const int threshold = 30 + static_cast<int>(random() % 69);
    std::vector<bool> done(scene.values.size());
    double largest = 0;
    for (int start = 0; start < 47 * 33; ++start) {
      std::vector<int> open{start};
      double area = 0;
      while (!open.empty()) {
        const int i = open.back(), x = i % 47, y = i / 47;
        open.pop_back();
        if (done[i] || scene.values[i] < threshold) continue;
        done[i] = true;
        area += scene.view.solid_angle(x, y);
        for (int v = std::max(0, y - 1); v <= std::min(32, y + 1); ++v) {
          for (int u = std::max(0, x - 1); u <= std::min(46, x + 1); ++u)
            open.push_back(v * 47 + u);
        }
      }
      largest = std::max(largest, area);
    }
    EXPECT_NEAR(scene.measure(threshold).solid_angle, largest, 1e-6) << "round " << round;
  }
}

TEST(HotSpot, IgnoresWhatIsNotSeen) {
  Scene scene(kPerspective);
  scene.paint(*scene.view.direction(100, 100), 0.05, 5000);
  for (auto& v : scene.validity) v = static_cast<std::uint8_t>(Validity::Blind);
  EXPECT_FALSE(scene.measure(1000).present);
}

TEST(Signals, GiveAnglesAndTemperaturesInTheirUnits) {
  const double c = std::cos(optics::radians(20)), s = std::sin(optics::radians(20));
  const HotSpot spot{true, {-c * std::sin(0.5), c * std::cos(0.5), -s}, 0.0025, 40000, 32768};
  const Signals signals = hot_spot_signals(spot, {0.04}, 65535);
  EXPECT_NEAR(signals.hot_spot_yaw, -optics::degrees(0.5), 1e-9);
  EXPECT_NEAR(signals.hot_spot_pitch, -20, 1e-9);
  EXPECT_NEAR(signals.hot_spot_area, 2.5, 1e-9);
  EXPECT_NEAR(signals.hot_spot_peak_temperature, 40000 * 0.04 - 273.15, 1e-9);
  EXPECT_NEAR(signals.hot_spot_mean_intensity, 50, 0.01);
}

TEST(Signals, WithoutAHotSpotOrAScaleSayNotValid) {
  const Signals none = hot_spot_signals({}, {0.04}, 65535);
  EXPECT_EQ(none.hot_spot_area, 0);
  EXPECT_FALSE(is_valid(none.hot_spot_yaw));
  EXPECT_FALSE(is_valid(none.hot_spot_peak_temperature));
  const Signals colour = hot_spot_signals({true, {0, 1, 0}, 1, 255, 200}, {}, 255);
  EXPECT_FALSE(is_valid(colour.hot_spot_peak_temperature));
  EXPECT_EQ(colour.hot_spot_peak_intensity, 100);
}

}  // namespace
}  // namespace orbwatch::signals
