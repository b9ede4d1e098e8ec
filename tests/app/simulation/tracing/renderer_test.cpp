// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/tracing/renderer.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/app/simulation/camera_truth.h"
#include "tests/app/simulation/marching_tracer.h"

namespace orbwatch::app::simulation {
namespace {

std::shared_ptr<const Machine> machine(const MachineSettings& settings = {}) {
  return Machine::make(settings, {}).value();
}

/// Position and field of view of the tests' cameras.
struct Stand {
  const char* name;
  Vec3 position;
  double fov;
};

const std::vector<Stand> kStands{
    {"narrow, from the front", {160, -430, 480}, 13},
    {"wide, from a corner: ball small, pool and nozzle seen directly too", {-450, -400, 650}, 70},
    {"beside the table: workpiece before the ball", {-420, -250, 120}, 50},
    {"low beside the table: its edge hides a part of the ball", {315, 60, 20}, 60},
    {"from outside through the front wall", {208, -530, 489}, 30},
};

template <class Sample>
std::vector<Sample> picture(const Renderer& renderer, double seconds,
                            Redraw redraw = Redraw::WhatMoves) {
  std::vector<Sample> samples(renderer.size() / sizeof(Sample));
  renderer.render(seconds, reinterpret_cast<std::byte*>(samples.data()), redraw);
  return samples;
}

Pinhole camera_at(const Stand& stand, int width, int height) {
  return look_at(stand.position, MachineSettings{}.ball.centre, stand.fov, width, height);
}

TEST(Renderer, RedrawsExactlyWhatChanged) {
  for (const Stand& stand : kStands) {
    for (const CameraKind kind : {CameraKind::Colour, CameraKind::Thermal}) {
      const Renderer renderer(machine(), camera_at(stand, 203, 149), {kind});
      const auto first = picture<std::uint8_t>(renderer, 0);
      bool moved = false;
      for (const double t : {0.0, 0.7, 3.3, 5.05, 9.9, 1234.5}) {
        const auto quick = picture<std::uint8_t>(renderer, t);
        ASSERT_EQ(quick, picture<std::uint8_t>(renderer, t, Redraw::Everything))
            << stand.name << " at " << t;
        moved = moved || quick != first;
      }
      EXPECT_TRUE(moved) << stand.name;
    }
  }
}

using Body = MarchingTracer::Body;

/// Agreement of the pictures of the product and of the other tracer.
struct Comparison {
  int pixels = 0;
  int different = 0;
  std::array<int, 6> direct{};    ///< pixels by Body
  std::array<int, 6> mirrored{};  ///< pixels by Body, seen in the ball
};

void compare(const MachineSettings& settings, const Stand& stand, double seconds,
             Comparison& result) {
  constexpr int kWidth = 160, kHeight = 128;
  constexpr double kHottestAtRest = 55;  // degC: walls, table, lamp
  const Pinhole camera = camera_at(stand, kWidth, kHeight);
  const Renderer renderer(machine(settings), camera, {CameraKind::Thermal, 0.04});
  const auto counts = picture<std::uint16_t>(renderer, seconds);
  const MarchingTracer tracer(settings, seconds);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const auto end = tracer.trace(camera.position, camera.ray_through(u, v).direction);
      ++(end.mirrored ? result.mirrored : result.direct)[static_cast<std::size_t>(end.body)];
      const double wanted = tracer.temperature(end);
      const double got = counts[static_cast<std::size_t>(v * kWidth + u)] * 0.04 - 273.15;
      const bool same = wanted > 0 ? std::abs(got - wanted) < 0.021 : got < kHottestAtRest;
      result.different += same ? 0 : 1;
      ++result.pixels;
    }
  }
}

TEST(Renderer, ThermalPixelsHaveTheTemperatureThatAnotherTracerFinds) {
  MachineSettings settings;
  settings.sparks.radius = {5, 9};
  Comparison result;
  for (const Stand& stand : kStands) {
    if (!settings.enclosure.contains(stand.position)) continue;  // required by the other tracer
    for (const double t : {3.3, 8.1}) compare(settings, stand, t, result);
  }
  // The two may differ where a ray grazes an edge and rounding decides.
  EXPECT_LT(result.different, result.pixels / 5000);
  for (const Body body : {Body::Workpiece, Body::Nozzle, Body::Spark}) {
    const auto index = static_cast<std::size_t>(body);
    EXPECT_GT(result.direct[index], 20) << index;
    EXPECT_GT(result.mirrored[index], 20) << index;
  }
}

/// Intersection of the mirrored sight through a pixel with the height of the workpiece's top: plain
/// algebra.
Vec3 mirrored_on_workpiece(const MachineSettings& settings, const Pinhole& camera, double u,
                           double v) {
  const Vec3 direction = camera.ray_through(u, v).direction;
  const Vec3 to_centre = settings.ball.centre - camera.position;
  const double nearest = dot(to_centre, direction);
  const double offset2 = dot(to_centre, to_centre) - nearest * nearest;
  const double radius = settings.ball.radius;
  const Vec3 hit = camera.position + direction * (nearest - std::sqrt(radius * radius - offset2));
  const Vec3 normal = (hit - settings.ball.centre) * (1 / radius);
  const Vec3 reflected = direction - normal * (2 * dot(direction, normal));
  return hit + reflected * ((settings.workpiece.hi.z - hit.z) / reflected.z);
}

TEST(Renderer, HottestThermalPixelShowsThePoolsCentre) {
  MachineSettings settings;
  settings.sparks.rate = 0;
  const Pinhole camera = look_at({49, 395, 500}, settings.ball.centre, 20, 640, 512);
  const Renderer renderer(machine(settings), camera, {CameraKind::Thermal});
  for (const double t : {0.5, 4.0, 7.5, 11.0}) {
    const auto pixels = picture<std::uint16_t>(renderer, t);
    const auto hottest = std::max_element(pixels.begin(), pixels.end()) - pixels.begin();
    const auto u = static_cast<double>(hottest % 640);
    const auto row = hottest / 640;
    const auto v = static_cast<double>(row);
    const MeltPool pool = process_at(settings, t).pool;
    const Vec3 shown = mirrored_on_workpiece(settings, camera, u, v);
    // The footprint of the pixel is the extent of its corners.
    double footprint = 0;
    for (const double du : {-0.5, 0.5}) {
      for (const double dv : {-0.5, 0.5}) {
        footprint = std::max(footprint,
                             norm(mirrored_on_workpiece(settings, camera, u + du, v + dv) - shown));
      }
    }
    EXPECT_LT(norm(shown - pool.centre), footprint * 1.01) << "at " << t;
    EXPECT_LT(footprint, 6) << "mm; or the test says nothing";
    EXPECT_NEAR(pixels[static_cast<std::size_t>(hottest)] * 0.04 - 273.15,
                pool.temperature_at(norm(shown - pool.centre)), 0.021);
  }
}

TEST(Renderer, ThermalSamplesSaturate) {
  MachineSettings settings;
  const Pinhole camera = look_at({49, 395, 500}, settings.ball.centre, 20, 320, 256);
  const Renderer renderer(machine(settings), camera, {CameraKind::Thermal, 0.02});
  const auto pixels = picture<std::uint16_t>(renderer, 4);
  EXPECT_EQ(*std::max_element(pixels.begin(), pixels.end()), 65535);
  EXPECT_GT(*std::min_element(pixels.begin(), pixels.end()), 280 / 0.02);
}

TEST(Renderer, TheBallFillsItsOutline) {
  // A speck instead of the ball exposes the wall behind it: the pixels that differ are the ball.
  constexpr int kSide = 400;
  MachineSettings speck;
  speck.ball.radius = 1e-3;
  for (const Stand& stand : {kStands[0], Stand{"from the right", {480, 200, 530}, 22}}) {
    const Pinhole camera = camera_at(stand, kSide, kSide);
    const BallOutline outline = truth_of(camera, MachineSettings{}.ball).outline;
    const auto with = picture<std::uint8_t>(Renderer(machine(), camera, {}), 1);
    const auto without = picture<std::uint8_t>(Renderer(machine(speck), camera, {}), 1);
    int inside = 0, inside_differs = 0, outside_differs = 0;
    double farthest = 0;
    for (std::size_t i = 0; i < kSide * kSide; ++i) {
      const std::size_t u = i % kSide, v = i / kSide;
      const double radius =
          std::hypot(static_cast<double>(u) - outline.cx, static_cast<double>(v) - outline.cy);
      const bool differs = !std::equal(&with[i * 3], &with[i * 3] + 3, &without[i * 3]);
      if (differs) farthest = std::max(farthest, radius);
      if (radius < outline.radius) {
        ++inside;
        inside_differs += differs ? 1 : 0;
      } else if (radius > outline.radius + 0.75) {
        outside_differs += differs ? 1 : 0;
      }
    }
    EXPECT_EQ(outside_differs, 0) << stand.name;
    EXPECT_GT(inside_differs, 0.98 * inside) << stand.name;
    EXPECT_GT(farthest, outline.radius - 0.5) << stand.name;
    EXPECT_NEAR(inside, std::numbers::pi * outline.radius * outline.radius, 0.01 * inside);
  }
}

TEST(Renderer, APixelFullOfSparkHasItsGlow) {
  MachineSettings settings;
  settings.sparks.radius = {8, 9};
  const Tone tone;
  constexpr int kSide = 300;
  const Pinhole camera = camera_at(kStands[1], kSide, kSide);
  const Renderer renderer(machine(settings), camera, {});
  const auto pixels = picture<std::uint8_t>(renderer, 3.3);
  const MarchingTracer tracer(settings, 3.3);
  const auto end = [&](double u, double v) {
    return tracer.trace(camera.position, camera.ray_through(u, v).direction);
  };
  int full = 0;
  for (int v = 0; v < kSide; ++v) {
    for (int u = 0; u < kSide; ++u) {
      const auto corner = end(u - 0.5, v - 0.5);
      if (corner.body != Body::Spark || end(u + 0.5, v - 0.5).body != Body::Spark ||
          end(u - 0.5, v + 0.5).body != Body::Spark || end(u + 0.5, v + 0.5).body != Body::Spark) {
        continue;
      }
      ++full;
      const Rgb8 glow = tone.encode(tone.incandescence(tracer.temperature(corner)));
      const auto* const rgb = &pixels[static_cast<std::size_t>((v * kSide + u) * 3)];
      ASSERT_TRUE(std::equal(glow.begin(), glow.end(), rgb)) << u << ", " << v;
    }
  }
  EXPECT_GT(full, 20);
}

TEST(Renderer, ThePoolGlowsWhiteAndTheRestIsLitModerately) {
  MachineSettings settings;
  settings.sparks.rate = 0;
  const Pinhole camera = look_at({160, -430, 480}, settings.ball.centre, 13, 500, 500);
  const Renderer renderer(machine(settings), camera, {});
  const auto pixels = picture<std::uint8_t>(renderer, 3.3);
  const Vec3 centre = process_at(settings, 3.3).pool.centre;
  int white = 0, white_off_the_pool = 0;
  for (int v = 0; v < 500; ++v) {
    for (int u = 0; u < 500; ++u) {
      const auto* const rgb = &pixels[static_cast<std::size_t>((v * 500 + u) * 3)];
      if (std::min({rgb[0], rgb[1], rgb[2]}) < 255) continue;
      ++white;
      const double off = norm(mirrored_on_workpiece(settings, camera, u, v) - centre);
      white_off_the_pool += off > 15 ? 1 : 0;
    }
  }
  EXPECT_GT(white, 8);
  EXPECT_EQ(white_off_the_pool, 0);
}

}  // namespace
}  // namespace orbwatch::app::simulation
