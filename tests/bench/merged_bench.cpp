// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "tests/bench/opencv_header.h"
#include "tests/bench/opencv_merge.h"
#include "tests/bench/paired_run.h"

/// Merged views of two cameras, ours by every kernel and OpenCV's alternately, one thread each:
/// benchmarks labelled merged/case. Times and ratios are counters, one per contestant.
namespace orbwatch::bench {
namespace {

/// Largest difference between our picture and OpenCV's; the views differ above it.
constexpr double kLargestDifference = 3;  // rms, of 255

double difference(const Frame& ours, const cv::Mat& peer) {
  const double full_scale = peer.depth() == CV_16U ? 65535 : 255;
  const double values = static_cast<double>(peer.total() * peer.elemSize() / peer.elemSize1());
  return cv::norm(header_of(ours.planes[0]), peer, cv::NORM_L2) / std::sqrt(values) * 255 /
         full_scale;
}

void merged(benchmark::State& state, const MergedCase& wanted) {
  state.SetLabel("merged/" + std::string(wanted.name));
  std::vector<std::unique_ptr<MergedView>> ours;
  for (const remap::Kernel* kernel : remap::kernels()) {
    ours.push_back(std::make_unique<MergedView>(wanted, *kernel));
  }
  OpencvMerge peer(*ours.front());
  std::vector<Contestant> contestants{{"opencv_merge", [&] { peer.run(); }, {}}};
  for (std::size_t i = 0; i < ours.size(); ++i) {
    contestants.push_back(
        {std::string(remap::kernels()[i]->name), [&view = *ours[i]] { view.run(); }, {}});
  }

  for (auto _ : state) {
    const std::string error = run_by_turns(contestants, pairs);
    if (!error.empty()) return state.SkipWithError(error.c_str());
    state.SetIterationTime(median(contestants.back().milliseconds) / 1e3);
  }
  for (const Contestant& contestant : contestants) {
    state.counters[contestant.name + "_ms"] = median(contestant.milliseconds);
  }
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const Contestant& contestant = contestants[i + 1];
    state.counters[contestant.name + "_vs_opencv_merge"] =
        paired_ratio(contestants.front(), contestant);
    const double shown = difference(ours[i]->output(), peer.output());
    const double measured = difference(*ours[i]->measured(), peer.measured());
    state.counters["difference_rms"] = std::max(shown, measured);
    if (!(std::max(shown, measured) <= kLargestDifference)) {
      return state.SkipWithError("OpenCV's view is another than ours");
    }
  }
}

const bool kAdded = [] {
  for (const MergedCase& wanted : kMergedCases) {
    if (!OpencvMerge::takes(wanted)) continue;
    benchmark::RegisterBenchmark(("merged/" + std::string(wanted.name)).c_str(), merged, wanted)
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace orbwatch::bench
