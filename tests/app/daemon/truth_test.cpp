#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "app/config/configuration.h"
#include "app/pictures/colour_maps.h"
#include "app/pipeline/view_renderer.h"
#include "app/simulation/camera_truth.h"
#include "app/simulation/process.h"
#include "app/simulation/renderer.h"
#include "app/simulation/static_scene.h"
#include "hal/frame_pool.h"
#include "proc/optics/angle.h"
#include "proc/optics/rotation.h"
#include "proc/signals/hot_spot.h"
#include "proc/signals/measure.h"

/// What the product computes beside what the simulated machine knows: its pictures come from plain
/// vector reflection and never saw a ball model.
namespace orbwatch::app {
namespace {

using optics::Vec3;
using simulation::CameraTruth;
using simulation::Pinhole;

const simulation::Vec3 kThermalPosition{49.4, 395.4, 500.6};

optics::BallProjection projection_of(const CameraTruth& truth) {
  const auto& m = truth.rotation;
  const optics::Mat3 rotation{{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}};
  const optics::Outline outline{
      {truth.outline.cx, truth.outline.cy}, truth.outline.radius, truth.outline.radius, 0};
  return optics::BallProjection::make(optics::BallModel::exact(truth.alpha).value(), outline,
                                      rotation)
      .value();
}

TEST(Truth, TheShippedDemoFileDescribesItsSimulatedCameras) {
  const auto configuration =
      load_configuration(std::filesystem::path(ORBWATCH_SOURCE_DIR) / "platform/config/demo.toml");
  ASSERT_TRUE(configuration) << configuration.error().message;
  const simulation::MachineSettings machine;
  for (const CameraSettings& camera : configuration->cameras) {
    const auto& part = camera.simulated.value();
    const Pinhole pinhole =
        simulation::look_at({part.position[0], part.position[1], part.position[2]},
                            machine.ball.centre, part.h_fov, camera.width, camera.height);
    const CameraTruth truth = simulation::truth_of(pinhole, machine.ball);
    EXPECT_NEAR(camera.ball.centre[0], truth.outline.cx, 0.01) << camera.name;
    EXPECT_NEAR(camera.ball.centre[1], truth.outline.cy, 0.01) << camera.name;
    EXPECT_NEAR(camera.ball.radius.value(), truth.outline.radius, 0.01) << camera.name;
    EXPECT_NEAR(camera.ball.alpha.value(), truth.alpha, 0.001) << camera.name;
    const Numbers3 rotation = camera.ball.rotation.value();
    EXPECT_NEAR(rotation[0], truth.yaw, 0.001) << camera.name;
    EXPECT_NEAR(rotation[1], truth.pitch, 0.001) << camera.name;
    EXPECT_NEAR(rotation[2], truth.roll, 0.001) << camera.name;
  }
}

TEST(Truth, TheExactModelIsPlainReflection) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  const simulation::Sphere ball{{10, -20, 300}, 40};
  for (int i = 0; i < 5000; ++i) {
    const double distance = ball.radius * (1.05 + 30 * unit(random));
    const Vec3 away =
        optics::normalized({unit(random) - 0.5, unit(random) - 0.5, 0.6 * (unit(random) - 0.5)});
    const Pinhole camera =
        simulation::look_at(ball.centre + away * distance, ball.centre, 60, 900, 700);
    const CameraTruth truth = simulation::truth_of(camera, ball);
    const double angle = 2 * std::numbers::pi * unit(random), rho = 0.999 * std::sqrt(unit(random));
    const optics::Vec2 pixel{truth.outline.cx + rho * truth.outline.radius * std::cos(angle),
                             truth.outline.cy + rho * truth.outline.radius * std::sin(angle)};
    const auto sight = simulation::sight_along(camera.ray_through(pixel.u, pixel.v), ball);
    ASSERT_TRUE(sight.on_ball());
    const auto direction = projection_of(truth).direction(pixel);
    ASSERT_TRUE(direction);
    // Close to the limb rounding of the hit point counts most.
    EXPECT_LT(optics::degrees(optics::angle_between(*direction, sight.mirrored.direction)), 1e-5);
  }
}

/// A thermal camera without noise that looks at a machine without sparks, and the measured view.
class PoolTruth : public testing::Test {
 protected:
  static constexpr int kWidth = 640, kHeight = 512;
  static constexpr double kKelvinPerCount = 0.04;

  PoolTruth() {
    simulation::MachineSettings settings;
    settings.sparks.rate = 0;
    machine = simulation::Machine::make(settings, hal::Clock::now()).value();
    pinhole = simulation::look_at(kThermalPosition, settings.ball.centre, 22.5, kWidth, kHeight);
  }

  signals::Signals measure(double seconds) {
    const simulation::Renderer renderer(machine, pinhole,
                                        {simulation::CameraKind::Thermal, kKelvinPerCount});
    auto buffer = hal::make_frame_pool(PixelFormat::Y16, kWidth, kHeight, 1).acquire();
    renderer.render(seconds, buffer->memory);
    hal::FrameSet set;
    set.frames[0] = buffer;

    const auto view = optics::ViewProjection::make(
                          {optics::ViewKind::Perspective, {-115, -40, 0}, 70, {}, 1000, 800})
                          .value();
    ViewPlan plan{0, "pool", view, {}, Combine::Mix, remap::Interpolation::Bilinear, 0};
    plan.sources.push_back({0,
                            {PixelFormat::Y16, {}, kWidth, kHeight, 30},
                            projection_of(simulation::truth_of(pinhole, machine->settings().ball)),
                            1,
                            {colour_map_table("grey"), 0, 65535}});
    ViewRenderer remapper(plan);
    View out = remapper.make_view();
    WorkerPool workers(1);
    remapper.render(set, out, workers);
    const signals::RadiometricScale scale{kKelvinPerCount};
    signals::HotSpotDetector detector(view);
    return signals::hot_spot_signals(
        detector.measure(out.radiometric, out.validity,
                         scale.counts(machine->settings().pool.melting_point)),
        scale, 65535);
  }

  /// Mean direction, as reflected, of the sights whose end lies in the molten pool.
  Vec3 reflected_direction(double seconds) const {
    const auto& settings = machine->settings();
    const auto truth = simulation::process_at(settings, seconds);
    Vec3 sum;
    constexpr int kFine = 4;  // sights per pixel and axis
    for (int v = 0; v < kHeight * kFine; ++v) {
      for (int u = 0; u < kWidth * kFine; ++u) {
        const auto ray = pinhole.ray_through(1.0 * u / kFine, 1.0 * v / kFine);
        const auto sight = simulation::sight_along(ray, settings.ball);
        if (!sight.on_ball()) continue;
        const auto end = simulation::static_end(settings, sight);
        if (end.hit.surface != simulation::Surface::Workpiece || end.hit.normal.z < 0.5) continue;
        const Vec3 point = end.ray.at(end.hit.distance);
        if (optics::norm(point - truth.pool.centre) < truth.pool.radius)
          sum = sum + end.ray.direction;
      }
    }
    return optics::normalized(sum);
  }

  std::shared_ptr<const simulation::Machine> machine;
  Pinhole pinhole;
};

TEST_F(PoolTruth, IsMeasuredWhereReflectionShowsIt) {
  for (const double seconds : {0.0, 2.5, 5.0, 8.0, 10.5}) {
    const signals::Signals signals = measure(seconds);
    const auto truth = simulation::process_at(machine->settings(), seconds);
    const Vec3 direction = reflected_direction(seconds);
    const double yaw = optics::degrees(std::atan2(direction.x, direction.y));
    const double pitch = optics::degrees(std::asin(direction.z));
    EXPECT_NEAR(signals.hot_spot_yaw, yaw, 0.8) << seconds << " s";
    EXPECT_NEAR(signals.hot_spot_pitch, pitch, 0.8) << seconds << " s";
    EXPECT_LT(signals.hot_spot_peak_temperature, truth.pool.peak + 1) << seconds << " s";
    EXPECT_GT(signals.hot_spot_peak_temperature, truth.pool.peak - 80) << seconds << " s";
  }
}

}  // namespace
}  // namespace orbwatch::app
