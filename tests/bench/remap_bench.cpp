#include <benchmark/benchmark.h>

#include <opencv2/imgproc.hpp>
#include <vector>

#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/coordinate_grid.h"
#include "proc/remap/remap.h"

/// The remap kernel beside OpenCV's, one thread each, on the same map: a 1080p view of a ball of
/// 1490 px radius in a 3000x3000 picture. Only the ratio means something on another machine.
namespace orbwatch {
namespace {

constexpr int kSource = 3000;

struct Scene {
  explicit Scene(const optics::YawPitchRoll& orientation)
      : view(optics::ViewProjection::make(
                 {optics::ViewKind::Perspective, orientation, 90, {}, 1920, 1080})
                 .value()),
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
  const ImageView<T> target{out.ptr<T>(), 1920, 1080, out.channels(),
                            static_cast<std::ptrdiff_t>(out.step1())};
  for (auto _ : state) {
    remap::remap(grid, picture, remap::Interpolation::Bilinear, target, {0, grid.tiles_y()});
    benchmark::DoNotOptimize(out.data);
  }
  state.counters["grid_KB"] = static_cast<double>(grid.bytes()) / 1024;
}

void remap_opencv(benchmark::State& state, PixelFormat format) {
  const Scene scene = scene_of(state);
  cv::Mat map(1080, 1920, CV_32FC2, cv::Scalar(-1, -1)), fixed, weights, out;
  for (int y = 0; y < 1080; ++y) {
    for (int x = 0; x < 1920; ++x) {
      if (const auto p = scene.ball.pixel(scene.view.direction(x, y))) {
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

void build_grid(benchmark::State& state) {
  const Scene scene = scene_of(state);
  for (auto _ : state) {
    const remap::CoordinateGrid grid(scene.view, scene.ball, kSource, kSource);
    benchmark::DoNotOptimize(grid.bytes());
  }
}

#define ORBWATCH_BENCH(name, T, format)                                                            \
  BENCHMARK_CAPTURE(remap_ours<T>, name, format)->DenseRange(0, 2)->Unit(benchmark::kMillisecond); \
  BENCHMARK_CAPTURE(remap_opencv, name, format)->DenseRange(0, 2)->Unit(benchmark::kMillisecond)

ORBWATCH_BENCH(grey, std::uint8_t, PixelFormat::Grey);
ORBWATCH_BENCH(rgb, std::uint8_t, PixelFormat::Rgb);
ORBWATCH_BENCH(y16, std::uint16_t, PixelFormat::Y16);
BENCHMARK(build_grid)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace orbwatch

BENCHMARK_MAIN();
