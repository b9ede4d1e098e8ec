#include <benchmark/benchmark.h>

#include <opencv2/imgproc.hpp>
#include <vector>

#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/coordinate_grid.h"
#include "proc/remap/remap.h"

/// The remap kernel beside OpenCV's, one thread each, on the same map: a 1080p view of a ball of
/// 1490 px radius in a 3000x3000 picture. And re-pointing such a view, with a machine's walls and
/// table too, beside what a map of full size takes. Only the ratio means something on another
/// machine.
namespace orbwatch {
namespace {

constexpr int kSource = 3000;

optics::ViewProjection full_hd_view(const optics::YawPitchRoll& orientation) {
  return optics::ViewProjection::make(
             {optics::ViewKind::Perspective, orientation, 90, {}, 1920, 1080})
      .value();
}

struct Scene {
  explicit Scene(const optics::YawPitchRoll& orientation)
      : view(full_hd_view(orientation)),
        ball(optics::BallProjection::make(optics::BallModel::exact(348.5).value(),
                                          {{1499.5, 1499.5}, 1490, 1490, 0}, {})
                 .value()) {}

  optics::ViewProjection view;
  optics::BallProjection ball;
};

Scene scene_of(const benchmark::State& state) {
  constexpr optics::YawPitchRoll kOrientations[]{{0, 0, 0}, {40, 20, 10}, {110, -30, 45}};
  return Scene(kOrientations[state.range(0)]);
}

int type_of(PixelFormat format) {
  return CV_MAKETYPE(format == PixelFormat::Y16 ? CV_16U : CV_8U, info(format).channels);
}

cv::Mat source_picture(PixelFormat format) {
  cv::Mat picture(kSource, kSource, type_of(format));
  cv::randu(picture, 0, 255);
  return picture;
}

template <class T>
void remap_all(const remap::CoordinateGrid& grid, const Picture& source, cv::Mat& out) {
  const ImageView<T> target{out.ptr<T>(), out.cols, out.rows, out.channels(),
                            static_cast<std::ptrdiff_t>(out.step1())};
  remap::remap(grid, source, remap::Interpolation::Bilinear, target, {0, grid.tiles_y()});
}

void remap_ours(benchmark::State& state, PixelFormat format) {
  const Scene scene = scene_of(state);
  const remap::CoordinateGrid grid(scene.view, scene.ball, kSource, kSource);
  const cv::Mat source = source_picture(format);
  cv::Mat out(1080, 1920, type_of(format));
  const Picture picture{format,
                        {},
                        kSource,
                        kSource,
                        reinterpret_cast<const std::byte*>(source.data),
                        static_cast<std::ptrdiff_t>(source.step)};
  for (auto _ : state) {
    if (format == PixelFormat::Y16) {
      remap_all<std::uint16_t>(grid, picture, out);
    } else {
      remap_all<std::uint8_t>(grid, picture, out);
    }
    benchmark::DoNotOptimize(out.data);
  }
  state.counters["grid_KB"] = static_cast<double>(grid.bytes()) / 1024;
}

void remap_opencv(benchmark::State& state, PixelFormat format) {
  const Scene scene = scene_of(state);
  cv::Mat map(1080, 1920, CV_32FC2, cv::Scalar(-1, -1)), fixed, weights, out;
  for (int y = 0; y < 1080; ++y) {
    for (int x = 0; x < 1920; ++x) {
      if (const auto p = scene.ball.pixel(*scene.view.direction(x, y))) {
        map.at<cv::Vec2f>(y, x) = {static_cast<float>(p->u), static_cast<float>(p->v)};
      }
    }
  }
  cv::convertMaps(map, cv::Mat(), fixed, weights, CV_16SC2);
  cv::setNumThreads(1);
  const cv::Mat source = source_picture(format);
  for (auto _ : state) {
    cv::remap(source, out, fixed, weights, cv::INTER_LINEAR);
    benchmark::DoNotOptimize(out.data);
  }
}

/// A camera 12 radii from a ball of 100 mm in a machine of 1200 x 1000 x 800 mm with its table.
struct MachineScene {
  explicit MachineScene(const optics::YawPitchRoll& orientation)
      : view(full_hd_view(orientation)), ball(camera_in_machine()) {}

  static optics::BallProjection camera_in_machine() {
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

  optics::ViewProjection view;
  optics::BallProjection ball;
};

/// At the table, across the machine, at the ceiling, back at the camera.
MachineScene machine_of(const benchmark::State& state) {
  constexpr optics::YawPitchRoll kOrientations[]{
      {-115, -40, 0}, {110, -30, 45}, {90, 50, 0}, {170, 0, 0}};
  return MachineScene(kOrientations[state.range(0)]);
}

template <class AnyScene>
void build_grid(benchmark::State& state, AnyScene (*scene_for)(const benchmark::State&)) {
  const AnyScene scene = scene_for(state);
  std::size_t bytes = 0;
  for (auto _ : state) {
    const remap::CoordinateGrid grid(scene.view, scene.ball, kSource, kSource);
    benchmark::DoNotOptimize(bytes = grid.bytes());
  }
  state.counters["KB"] = static_cast<double>(bytes) / 1024;
}

/// The peer: every pixel once, in double, as cv::remap takes it.
template <class AnyScene>
void build_full_map(benchmark::State& state, AnyScene (*scene_for)(const benchmark::State&)) {
  const AnyScene scene = scene_for(state);
  cv::Mat map(1080, 1920, CV_32FC2);
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
  state.counters["KB"] = static_cast<double>(map.total() * map.elemSize()) / 1024;
}

BENCHMARK_CAPTURE(remap_ours, grey, PixelFormat::Grey)
    ->DenseRange(0, 2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(remap_opencv, grey, PixelFormat::Grey)
    ->DenseRange(0, 2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(remap_ours, rgb, PixelFormat::Rgb)
    ->DenseRange(0, 2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(remap_opencv, rgb, PixelFormat::Rgb)
    ->DenseRange(0, 2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(remap_ours, y16, PixelFormat::Y16)
    ->DenseRange(0, 2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(remap_opencv, y16, PixelFormat::Y16)
    ->DenseRange(0, 2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build_grid, far_away, scene_of)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build_full_map, far_away, scene_of)
    ->DenseRange(0, 2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build_grid, box_and_table, machine_of)
    ->DenseRange(0, 3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build_full_map, box_and_table, machine_of)
    ->DenseRange(0, 3)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace orbwatch

BENCHMARK_MAIN();
