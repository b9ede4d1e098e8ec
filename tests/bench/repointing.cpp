// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>

#include "proc/optics/scene_proxy.h"
#include "proc/remap/remap.h"
#include "tests/bench/rig.h"

/// Re-pointing a 1080p view, in the bench's rig and with a machine's walls and table, compared with
/// the time for a map of full size.
namespace orbwatch::bench {
namespace {

constexpr int kSource = 3000;

struct Scene {
  optics::ViewProjection view;
  optics::BallProjection ball;
};

Scene far_away(const benchmark::State& state) {
  const Rig rig(kViews[state.range(0)], kSource);
  return {rig.view, rig.ball};
}

/// A camera 12 radii from a ball of 100 mm in a machine of 1200 x 1000 x 800 mm with its table.
optics::BallProjection ball_in_machine() {
  const optics::Ball mirror{{120, 60, 430}, 50};
  const optics::Vec3 forward = optics::normalized({-0.1519, 0.9832, -0.1010});
  const optics::Vec3 right = optics::normalized(optics::cross(forward, {0, 0, 1}));
  const optics::CalibratedCamera camera{
      optics::Lens::make({kSource, kSource, 15785, 15785, 1499.5, 1499.5}).value(),
      {{right, optics::cross(forward, right), forward}, mirror.centre - forward * 600},
      {}};
  optics::Scene machine;
  machine.room = optics::Scene::Room::Box;
  machine.walls = {{-600, -500, 0}, {600, 500, 800}};
  machine.obstacles = {{{-250, -200, 100}, {250, 200, 140}}};
  return optics::BallProjection::make(optics::BallModel::Kind::Exact, camera, mirror,
                                      optics::SceneProxy::make(machine, mirror).value())
      .value();
}

/// Orientations towards the table, across the machine, to the ceiling, back to the camera.
Scene box_and_table(const benchmark::State& state) {
  constexpr optics::YawPitchRoll kOrientations[]{
      {-115, -40, 0}, {110, -30, 45}, {90, 50, 0}, {170, 0, 0}};
  NamedView named = kViews[0];
  named.orientation = kOrientations[state.range(0)];
  return {Rig(named, kSource).view, ball_in_machine()};
}

void build_grid(benchmark::State& state, Scene (*scene_for)(const benchmark::State&)) {
  const Scene scene = scene_for(state);
  std::size_t bytes = 0;
  for (auto _ : state) {
    const remap::CoordinateGrid grid(scene.view, scene.ball, kSource, kSource);
    benchmark::DoNotOptimize(bytes = grid.bytes());
  }
  state.counters["bytes"] = static_cast<double>(bytes);
}

/// The peer: a map in cv::remap's form, with every pixel computed once, in double.
void build_full_map(benchmark::State& state, Scene (*scene_for)(const benchmark::State&)) {
  const Scene scene = scene_for(state);
  cv::Mat map(scene.view.height(), scene.view.width(), CV_32FC2);
  for (auto _ : state) {
    for (int y = 0; y < map.rows; ++y) {
      for (int x = 0; x < map.cols; ++x) {
        const auto p = scene.ball.pixel(*scene.view.direction(x, y));
        map.at<cv::Vec2f>(y, x) =
            p ? cv::Vec2f(static_cast<float>(p->u), static_cast<float>(p->v)) : cv::Vec2f(-1, -1);
      }
    }
    benchmark::DoNotOptimize(map.data);
  }
  state.counters["bytes"] = static_cast<double>(map.total() * map.elemSize());
}

BENCHMARK_CAPTURE(build_grid, far_away, far_away)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build_full_map, far_away, far_away)
    ->DenseRange(0, 2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build_grid, box_and_table, box_and_table)
    ->DenseRange(0, 3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build_full_map, box_and_table, box_and_table)
    ->DenseRange(0, 3)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace orbwatch::bench
