// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/watched_input.h"

#include <array>
#include <cstdlib>
#include <utility>

namespace orbwatch::hal {
namespace {

/// Batches per read(), so that one line does not starve the others.
constexpr int kBatches = 4;

/// Edges of a line that the kernel keeps: a full batch may mean that more are lost.
constexpr std::size_t kKernelQueue = 16;

}  // namespace

std::optional<EdgeEvent> EdgeFilter::take(const EdgeEvent& edge) {
  const bool kept = due_ != TimePoint::max() && edge.stamp - last_.stamp >= period_;
  due_ = edge.stamp + wait();
  doubted_ = false;
  lost_ += edge.lost_before;
  if (edge.stamp < made_up_) return std::nullopt;
  const EdgeEvent before = std::exchange(last_, edge);
  if (edge.lost_before > 0) doubt();
  if (period_.count() <= 0) {
    if (edge.lost_before % 2 == 0)
      level_ = !level_;  // an odd number of lost edges led to the other level
    return last_ = {edge_to(level_), edge.stamp};
  }
  return kept ? change_to(before.edge == Edge::Rising, before.stamp) : std::nullopt;
}

std::optional<EdgeEvent> EdgeFilter::settle(bool level, TimePoint now) {
  const bool expected = last_.edge == Edge::Rising;
  if (level != expected && !std::exchange(doubted_, true)) {
    due_ = now + wait();
    return std::nullopt;
  }
  due_ = TimePoint::max();
  doubted_ = false;
  in_doubt_ = false;
  return level == expected ? change_to(level, last_.stamp) : make_up(level, now);
}

void EdgeFilter::doubt() {
  if (in_doubt_ || period_.count() > 0) return;  // each burst with a period ends with a reading
  in_doubt_ = true;
  readings_ = 0;
}

std::optional<EdgeEvent> EdgeFilter::confirm(bool level, TimePoint now) {
  readings_ += level == level_ ? 1 : -1;
  if (std::abs(readings_) < kReadings) return std::nullopt;
  in_doubt_ = false;
  return readings_ > 0 ? std::nullopt : make_up(level, now);
}

std::optional<EdgeEvent> EdgeFilter::make_up(bool level, TimePoint now) {
  ++lost_;
  made_up_ = now;
  last_ = {edge_to(level), std::max(now, last_.stamp)};  // edges may be newer than `now`
  return change_to(level, last_.stamp);
}

std::optional<EdgeEvent> EdgeFilter::change_to(bool level, TimePoint stamp) {
  if (level == std::exchange(level_, level)) return std::nullopt;
  return EdgeEvent{edge_to(level), stamp};
}

WatchedInput::WatchedInput(LineBackEnd& back_end, InputSettings settings,
                           LineRetry::OnFault on_fault, TimePoint now)
    : back_end_(back_end), settings_(std::move(settings)), retry_(std::move(on_fault)) {
  open(now);
}

/// Also reads the level, from which edges alternate.
Result<> WatchedInput::open_line() {
  auto input = back_end_.open_input(settings_);
  if (!input) return tl::unexpected(input.error());
  const auto level = (*input)->level();
  if (!level) return fail(level.error().detail);
  const bool needs_debounce = !(*input)->is_debounced();
  filter_ = EdgeFilter(needs_debounce ? settings_.debounce : Clock::duration(0), *level);
  input_ = std::move(*input);
  ++opened_;
  state_->set(*level);
  return {};
}

void WatchedInput::read(TimePoint now) {
  std::array<EdgeEvent, kKernelQueue> edges;
  for (int batch = 0; input_ && batch < kBatches; ++batch) {
    // The level is read before the edges: an edge between the two must not count as lost.
    const LineResult<bool> level = filter_.in_doubt() ? input_->level() : false;
    if (!level) return fail_with(level.error(), now);
    const auto count = input_->take(edges);
    if (!count) return fail_with(count.error(), now);
    for (std::size_t i = 0; i < *count; ++i) forward(filter_.take(edges[i]));
    if (*count == edges.size()) filter_.doubt();
    if (*count == 0 && filter_.in_doubt()) forward(filter_.confirm(*level, now));
    count_lost();
    if (*count == 0) return;
  }
}

void WatchedInput::run(TimePoint now) {
  if (now < due()) return;
  if (!input_) return open(now);
  const auto level = input_->level();  // before edges, as in read()
  if (!level) return fail_with(level.error(), now);
  check_ = now + kLineCheckPeriod;
  read(now);
  if (!input_ || now < filter_.due()) return;
  forward(filter_.settle(*level, now));
  count_lost();
}

void WatchedInput::count_lost() { lost_ = lost_before_ + filter_.lost(); }

void WatchedInput::forward(const std::optional<EdgeEvent>& edge) {
  if (!edge) return;
  level_ = edge->edge == Edge::Rising;
  state_->set(level_);
  for (const OnEdge& on_edge : on_edge_) on_edge(*edge);
}

void WatchedInput::fail_with(const LineFaultReport& report, TimePoint now) {
  lost_before_ = lost_;
  input_.reset();
  state_->set(std::nullopt);
  retry_.failed(report, now);
}

void WatchedInput::open(TimePoint now) {
  if (const auto opened = open_line(); !opened) return retry_.refused(opened.error(), now);
  retry_.works();
  const bool level = *state_->active();
  // Changes in the meantime count as one edge, stamped now.
  if (level_ && *level_ != level) forward(EdgeEvent{edge_to(level), now});
  level_ = level;
}

}  // namespace orbwatch::hal
