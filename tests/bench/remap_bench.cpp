// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/opencv_remap.h"
#include "tests/bench/our_remap.h"
#include "tests/bench/paired_run.h"
#include "tests/bench/quality.h"
#include "tests/bench/rig.h"
#include "tests/bench/v360_remap.h"

/// Our kernels, cv::remap and v360 alternately on the same view, one thread each: benchmarks
/// labelled view/format/side of the source. Times, ratios and quality are counters, one per
/// contestant. The peers alias where the view is smaller than its source, ours does not: that costs
/// time, and quality is compared in the other cases only.
namespace orbwatch::bench {
namespace {

/// The contestants of one case.
struct Field {
  Field(const Rig& rig, const Frame& source) : opencv(rig, source), v360(rig, source.format) {
    for (const remap::Kernel* kernel : remap::kernels()) {
      ours.push_back(std::make_unique<OurRemap>(rig, source, *kernel));
    }
  }

  OpencvRemap opencv;
  V360Remap v360;
  std::vector<std::unique_ptr<OurRemap>> ours;  ///< one per kernel
};

void report_quality(benchmark::State& state, const std::string& name, const Quality& quality) {
  state.counters[name + "_rms"] = quality.rms;
  state.counters[name + "_max"] = quality.max;
}

/// Ranges of `state`: index in kViews, PixelFormat, side of the source.
void paired(benchmark::State& state) {
  const Rig rig(kViews[static_cast<std::size_t>(state.range(0))], static_cast<int>(state.range(2)));
  const auto format = static_cast<PixelFormat>(state.range(1));
  state.SetLabel(std::string(rig.named.name) + '/' + std::string(info(format).name) + '/' +
                 std::to_string(rig.source));
  Frame source = Frame::blank(format, rig.source, rig.source);
  source.fill_with_noise(1);
  Field field(rig, source);
  std::vector<Contestant> contestants{{"opencv", [&] { field.opencv.run(); }, {}},
                                      {"v360", [&] { field.v360.run(); }, {}}};
  for (std::size_t i = 0; i < field.ours.size(); ++i) {
    contestants.push_back(
        {std::string(remap::kernels()[i]->name), [&ours = *field.ours[i]] { ours.run(); }, {}});
  }

  for (auto _ : state) {
    const std::string error = run_by_turns(contestants, pairs);
    if (!error.empty()) return state.SkipWithError(error.c_str());
    state.SetIterationTime(median(contestants.back().milliseconds) / 1e3);
  }
  for (const Contestant& contestant : contestants) {
    state.counters[contestant.name + "_ms"] = median(contestant.milliseconds);
  }
  for (std::size_t i = 0; i < field.ours.size(); ++i) {
    const Contestant& ours = contestants[i + 2];
    state.counters[ours.name + "_vs_opencv"] = paired_ratio(contestants[0], ours);
    state.counters[ours.name + "_vs_v360"] = paired_ratio(contestants[1], ours);
    report_quality(state, ours.name, quality_of(rig, source, field.ours[i]->output()));
  }
  report_quality(state, "opencv", quality_of(rig, source, field.opencv.output()));
}

void add_cases(benchmark::internal::Benchmark* paired_benchmark) {
  paired_benchmark->ArgNames({"view", "format", "source"});
  for (const int source : {3000, 4096}) {
    for (std::size_t view = 0; view < kViews.size(); ++view) {
      const bool flat = kViews[view].kind == optics::ViewKind::Perspective;
      const auto add = [&](PixelFormat format) {
        paired_benchmark->Args(
            {static_cast<std::int64_t>(view), static_cast<std::int64_t>(format), source});
      };
      add(PixelFormat::Grey);
      if (!flat) continue;
      for (const auto format : {PixelFormat::Nv12, PixelFormat::Bgr, PixelFormat::Y16}) add(format);
    }
  }
}
BENCHMARK(paired)->Apply(add_cases)->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);

/// Removes "--pairs=N" from the arguments; false when N is not a number from 1 on.
bool take_pairs(int& argc, char** argv) {
  constexpr std::string_view kOption = "--pairs=";
  int kept = 0;
  for (int i = 0; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (!argument.starts_with(kOption)) {
      argv[kept++] = argv[i];
      continue;
    }
    const auto [end, error] =
        std::from_chars(argument.data() + kOption.size(), argument.data() + argument.size(), pairs);
    if (error != std::errc() || end != argument.data() + argument.size() || pairs < 1) return false;
  }
  argc = kept;
  return true;
}

}  // namespace
}  // namespace orbwatch::bench

int main(int argc, char** argv) {
  const bool good = orbwatch::bench::take_pairs(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (!good || benchmark::ReportUnrecognizedArguments(argc, argv)) {
    std::cerr << "usage: " << argv[0] << " [--pairs=N] [--benchmark_...]\n";
    return 2;
  }
  try {
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << '\n';
    return 1;
  }
  benchmark::Shutdown();
  return 0;
}
