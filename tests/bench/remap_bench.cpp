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
BENCHMARK(build_grid)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace orbwatch

BENCHMARK_MAIN();
