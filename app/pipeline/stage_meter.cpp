// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/stage_meter.h"

#include <algorithm>
#include <utility>

#include "hal/thread/cpu_time.h"

namespace orbwatch::app::pipeline {

using std::chrono::nanoseconds;

namespace {

double milliseconds(nanoseconds time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

}  // namespace

nanoseconds StageMeter::Growth::operator()(nanoseconds total) {
  return std::max(nanoseconds(0), total - std::exchange(counted_, std::max(counted_, total)));
}

void StageMeter::begin() { counted_ = hal::cpu_time_of_this_thread(); }

void StageMeter::end(Stage stage, nanoseconds helped) {
  const auto now = hal::cpu_time_of_this_thread();
  const auto own = now - std::exchange(counted_, now);
  busy_ += own;
  spent_[static_cast<std::size_t>(stage)] += own + helped;
}

void StageMeter::end_set(nanoseconds capture, nanoseconds sinks) {
  spent_[static_cast<std::size_t>(Stage::Capture)] += capture_(capture);
  spent_[static_cast<std::size_t>(Stage::Sinks)] += sinks_(sinks);
  for (std::size_t i = 0; i < kStages; ++i) meters_[i].add(spent_[i]);
  newest_ = std::exchange(spent_, {});
  newest_busy_ = std::exchange(busy_, nanoseconds(0));
}

void StageMeter::report(Status& status) const {
  status.busy_ms = milliseconds(newest_busy_);
  for (std::size_t i = 0; i < kStages; ++i) status.stages[i].cpu_ms = milliseconds(newest_[i]);
}

void StageMeter::roll(hal::Clock::duration elapsed, Status& status) {
  for (std::size_t i = 0; i < kStages; ++i) {
    const SecondMeter::Figures figures = meters_[i].roll(elapsed);
    status.stages[i].cpu_p50_ms = figures.p50_ms;
    status.stages[i].cpu_p99_ms = figures.p99_ms;
  }
}

}  // namespace orbwatch::app::pipeline
