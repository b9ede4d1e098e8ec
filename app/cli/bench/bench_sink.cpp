// SPDX-License-Identifier: Apache-2.0
#include "app/cli/bench/bench_sink.h"

#include <algorithm>
#include <chrono>

namespace orbwatch::app::cli {

Percentiles percentiles(std::vector<float>& samples) {
  if (samples.empty()) return {};
  std::ranges::sort(samples);
  const auto at = [&samples](double share) {
    const auto rank = static_cast<std::size_t>(share * static_cast<double>(samples.size()));
    return static_cast<double>(samples[std::min(rank, samples.size() - 1)]);
  };
  return {at(0.50), at(0.99)};
}

void BenchSink::Samples::clear() {
  values_.clear();
  sum_ = 0;
  count_ = 0;
}

void BenchSink::Samples::add(double value) {
  if (values_.size() < values_.capacity()) values_.push_back(static_cast<float>(value));
  sum_ += value;
  ++count_;
}

BenchSink::BenchSink(double seconds) {
  const auto most = static_cast<std::size_t>(seconds * kMostPerSecond) + 1;
  busy_.reserve(most);
  for (Samples& stage : stages_) stage.reserve(most);
  for (Samples& latency : latencies_) latency.reserve(most);
}

void BenchSink::accept(const ViewPtr& view) {
  const auto latency = hal::Clock::now() - view->stamp;
  const std::lock_guard lock(mutex_);
  if (!records_) return;
  latencies_[view->index].add(std::chrono::duration<double, std::milli>(latency).count());
}

void BenchSink::accept(const Status& status) {
  const std::lock_guard lock(mutex_);
  const bool is_new = status.frame_set != newest_.frame_set;
  newest_ = status;
  if (!records_ || !is_new) return;
  busy_.add(status.busy_ms);
  for (std::size_t i = 0; i < kStages; ++i) stages_[i].add(status.stages[i].cpu_ms);
}

void BenchSink::record() {
  const std::lock_guard lock(mutex_);
  records_ = true;
  first_ = newest_;
  busy_.clear();
  for (Samples& stage : stages_) stage.clear();
  for (Samples& latency : latencies_) latency.clear();
}

void BenchSink::report(BenchFigures& figures) {
  const std::lock_guard lock(mutex_);
  records_ = false;
  figures.frame_sets = newest_.frame_set - first_.frame_set;
  figures.overruns = newest_.overruns - first_.overruns;
  figures.realtime = newest_.realtime;
  figures.memory_locked = newest_.memory_locked;
  figures.busy = busy_.ranked();
  for (std::size_t i = 0; i < kStages; ++i) {
    figures.means[i] = stages_[i].mean();
    figures.stages[i] = stages_[i].ranked();
  }
  for (std::size_t i = 0; i < figures.cameras.size(); ++i) {
    figures.cameras[i].dropped = newest_.cameras[i].dropped - first_.cameras[i].dropped;
  }
  for (std::size_t i = 0; i < figures.views.size(); ++i) {
    figures.views[i].published = newest_.views[i].published - first_.views[i].published;
    figures.views[i].skipped = newest_.views[i].skipped - first_.views[i].skipped;
    figures.views[i].latency = latencies_[i].ranked();
  }
}

Status BenchSink::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

}  // namespace orbwatch::app::cli
