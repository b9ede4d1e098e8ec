// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "proc/align/detect/ball_detector.h"
#include "tests/bench/paired_run.h"
#include "tests/support/mirror_room.h"
#include "tests/support/picture_of_mat.h"

/// Time to find the ball in pictures of 12 megapixels, on one thread, compared with OpenCV's Hough
/// transform for circles, which does not distinguish a ball from a disc.
namespace {

using namespace orbwatch;

constexpr int kRepetitions = 7;
const cv::Size kSize(4000, 3000);
constexpr double kLimit = 100;  // ms

/// A simulated room, enlarged: tracing it at full size would take longer than everything else.
cv::Mat picture(std::uint64_t seed, double radius) {
  tests::MirrorRoomSettings settings;
  settings.seed = seed;
  settings.width = 1000;
  settings.height = 750;
  settings.radius = radius;
  cv::Mat large;
  cv::resize(tests::mirror_room(settings).pixels, large, kSize, 0, 0, cv::INTER_CUBIC);
  return large;
}

void hough(const cv::Mat& pixels) {
  // Uses a quarter of the resolution: the full one takes minutes.
  cv::Mat grey, small;
  cv::cvtColor(pixels, grey, cv::COLOR_BGR2GRAY);
  cv::resize(grey, small, {}, 0.25, 0.25, cv::INTER_AREA);
  std::vector<cv::Vec3f> circles;
  cv::HoughCircles(small, circles, cv::HOUGH_GRADIENT, 1, small.rows, 100, 100, 40, small.rows / 2);
}

}  // namespace

int main() {
  cv::setNumThreads(1);
  bool met = true;
  std::puts("| ball's radius, px | ours, ms | HoughCircles, ms | ratio |\n|---|---|---|---|");
  for (const double radius : {80.0, 150.0, 300.0}) {
    const cv::Mat pixels = picture(7, radius);
    std::vector<bench::Contestant> contestants{
        {"ours",
         [&] {
           if (!align::detect_ball(tests::picture_of_mat(pixels))) std::abort();
         },
         {}},
        {"HoughCircles", [&] { hough(pixels); }, {}}};
    const std::string error = bench::run_by_turns(contestants, kRepetitions);
    if (!error.empty()) {
      std::fprintf(stderr, "detection_bench: %s\n", error.c_str());
      return 1;
    }
    const double ours = bench::median(contestants[0].milliseconds);
    std::printf("| %.0f | %.1f | %.1f | %.2f |\n", 4 * radius, ours,
                bench::median(contestants[1].milliseconds),
                bench::paired_ratio(contestants[1], contestants[0]));
    met &= ours <= kLimit;
  }
  if (met || std::getenv("CI") != nullptr) return 0;
  std::fprintf(stderr, "detection_bench: above %.0f ms\n", kLimit);
  return 1;
}
