// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "proc/align/drift/drift_monitor.h"
#include "tests/support/picture_of_mat.h"
#include "tests/support/process_sequence.h"

/// Cost of DriftMonitor::observe() on a simulated process.
namespace {

using orbwatch::align::DriftLevel;
using orbwatch::align::DriftMonitor;
using orbwatch::optics::Outline;
using orbwatch::tests::ProcessSequence;
using orbwatch::tests::ProcessSettings;

constexpr double kRate = 30, kLimit = 2;  // pictures per second, % of a core

double thread_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

struct Case {
  const char* name;
  ProcessSettings settings;
  int magnified;  ///< size of the camera's pictures relative to the simulated ones
  bool colour;
  double shift;          ///< px in the simulated pictures, at half time
  bool is_flat = false;  ///< true without any texture that could be tracked
};

DriftMonitor monitor_of(const Case& c, const ProcessSequence& sequence) {
  const auto& limb = sequence.limb();
  const double m = c.magnified;
  const auto large = [&](double u) { return (u + 0.5) * m - 0.5; };
  const Outline outline{{large(limb.centre.u), large(limb.centre.v)}, m * limb.rx, m * limb.ry, 0};
  const auto model = orbwatch::optics::BallModel::make(orbwatch::optics::BallModel::Kind::Exact,
                                                       std::nullopt, c.settings.distance);
  const auto projection = orbwatch::optics::BallProjection::make(*model, outline, {});
  return DriftMonitor::make({c.magnified * c.settings.width, c.magnified * c.settings.height,
                             outline, *projection, std::nullopt},
                            {0.3, 0.6})
      .value();
}

/// Prints a row of the table; false when the limit is exceeded.
bool measure(const Case& c) {
  ProcessSequence sequence(c.settings);
  DriftMonitor monitor = monitor_of(c, sequence);
  constexpr int kFrames = 240, kWarm = 60;
  std::vector<double> costs;
  int measured = 0;
  for (int n = 0; n < kFrames; ++n) {
    const double turn = n > kFrames / 2 ? c.shift / sequence.focal_length() : 0;
    cv::Mat picture = sequence.frame(10 + n / kRate, {turn, turn / 2, 0});
    if (c.is_flat) picture.setTo(cv::mean(picture));
    if (c.magnified > 1) cv::resize(picture, picture, {}, c.magnified, c.magnified);
    if (c.colour) cv::cvtColor(picture, picture, cv::COLOR_GRAY2BGR);
    const double before = thread_ms();
    const auto state =
        monitor.observe(orbwatch::tests::picture_of_mat(picture),
                        std::chrono::nanoseconds(static_cast<long long>(1e9 * n / kRate)));
    if (n < kWarm) continue;
    costs.push_back(thread_ms() - before);
    measured += state->level != DriftLevel::NotMeasured ? 1 : 0;
  }
  double mean = 0;
  for (const double cost : costs) mean += cost / static_cast<double>(costs.size());
  std::ranges::sort(costs);
  const double share = mean * kRate / 10;
  std::printf("| %s | %.3f | %.3f | %.2f | %.2f %% | %d %% |\n", c.name, mean,
              costs[costs.size() / 2], costs.back(), share,
              static_cast<int>(100 * static_cast<std::size_t>(measured) / costs.size()));
  return share <= kLimit;
}

}  // namespace

int main() {
  const ProcessSettings still{41, 800, 640, 300, 12, false};
  ProcessSettings small = still;
  small.width = 320;
  small.height = 256;
  small.radius = 110;
  small.thermal = true;
  const std::vector<Case> cases{
      {"grey, 800x640, radius 300 px", still, 1, false, 0},
      {"colour, 1600x1280, radius 600 px", still, 2, true, 0},
      {"colour, 4000x3200, radius 1500 px", still, 5, true, 0},
      {"colour, 1600x1280, no texture", still, 2, true, 0, true},
      {"colour, 800x640, bumped by 40 px", still, 1, true, 40},
      {"thermal, 320x256, radius 110 px", small, 1, false, 0},
  };
  std::puts(
      "| camera | mean, ms | median | most | share of a core at 30 Hz | measured |\n"
      "|---|---|---|---|---|---|");
  bool passed = true;
  for (const Case& c : cases) passed = measure(c) && passed;
  return passed || std::getenv("CI") != nullptr ? EXIT_SUCCESS : EXIT_FAILURE;
}
