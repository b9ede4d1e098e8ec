// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "app/cli/bench/bench_figures.h"

namespace orbwatch::app::cli {
namespace {

/// Tolerated share of frame sets or pictures of a view that are late or omitted.
constexpr double kTolerated = 0.01;

std::string percent(double share) {
  return std::to_string(static_cast<int>(std::lround(100 * share))) + " %";
}

std::string rate_text(double rate) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", rate);
  return std::string(text) + " frame sets per second";
}

std::string largest_view(const BenchFigures& figures) {
  const auto largest = std::ranges::max_element(
      figures.views, {}, [](const auto& view) { return view.width * view.height; });
  if (largest == figures.views.end()) return "the views' size";
  return "the size of view " + largest->name + ", " + std::to_string(largest->width) + "x" +
         std::to_string(largest->height);
}

/// Load below which the processor time is not the reason for late frame sets.
constexpr double kBusy = 0.8;

/// First setting to lower: the one behind the stage with the most processor time.
std::string advice(const BenchFigures& figures) {
  const auto costliest = std::ranges::max_element(figures.means) - figures.means.begin();
  switch (static_cast<Stage>(costliest)) {
    case Stage::Capture:
      return "the cameras' size, or choose a pixel_format that is not compressed";
    case Stage::Halving:
      return "the cameras' size, or set interpolation = \"bilinear\" for views that may alias";
    case Stage::Views:
      return largest_view(figures);
    case Stage::Measurement:
      return "size or number of the recipe's regions";
    case Stage::Publication:
      return "the number of views";
    case Stage::Sinks:
      return "rate of [dds.jpeg], or the number of picture topics that are read";
  }
  return {};
}

}  // namespace

Verdict judge(const BenchFigures& figures) {
  const double period_ms = 1000 / figures.wanted_rate;
  const double own = figures.busy.p99 / period_ms;
  const double total = std::accumulate(figures.means.begin(), figures.means.end(), 0.0) /
                       (period_ms * static_cast<double>(figures.cores));
  const auto late = static_cast<double>(figures.overruns) / static_cast<double>(figures.frame_sets);
  double left_out = 0;
  for (const auto& view : figures.views) {
    const auto all = static_cast<double>(view.published + view.skipped);
    if (all > 0) left_out = std::max(left_out, static_cast<double>(view.skipped) / all);
  }

  Verdict verdict;
  verdict.used = std::max(own, total);
  const std::string of_what =
      own >= total ? "of the pipeline's thread" : "of " + std::to_string(figures.cores) + " cores";
  const std::string use = rate_text(figures.wanted_rate) + " take " + percent(verdict.used) +
                          " of the processor time " + of_what;
  verdict.fits = verdict.used <= 1 && late <= kTolerated && left_out <= kTolerated;
  if (verdict.fits) {
    verdict.sentence = "fits: " + use + ", margin " + percent(1 - verdict.used);
    return verdict;
  }
  verdict.sentence = "does not fit: " + use;
  if (late > kTolerated) verdict.sentence += "; " + percent(late) + " of them were late";
  if (left_out > kTolerated) {
    verdict.sentence += "; " + percent(left_out) + " of a view's pictures were left out";
  }
  if (verdict.used > kBusy) {
    verdict.sentence += "; lower first: " + advice(figures);
  } else {
    verdict.sentence += figures.realtime ? "; find what else runs on these cores"
                                         : "; allow real-time priorities, see [threads]";
  }
  return verdict;
}

}  // namespace orbwatch::app::cli
