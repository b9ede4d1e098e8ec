#include "hal/lines/edge_filter.h"

#include <utility>

namespace orbwatch::hal {

std::optional<EdgeEvent> EdgeFilter::take(const EdgeEvent& edge) {
  const bool kept = due_ != TimePoint::max() && edge.stamp - last_.stamp >= period_;
  const EdgeEvent before = std::exchange(last_, edge);
  due_ = edge.stamp + wait();
  doubted_ = false;
  if (period_.count() <= 0) {
    level_ = !level_;
    last_.edge = edge_to(level_);
    return last_;
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
  if (level == expected) return change_to(level, last_.stamp);
  ++found_lost_;
  last_ = {edge_to(level), now};
  return change_to(level, now);
}

std::optional<EdgeEvent> EdgeFilter::change_to(bool level, TimePoint stamp) {
  if (level == std::exchange(level_, level)) return std::nullopt;
  return EdgeEvent{edge_to(level), stamp};
}

}  // namespace orbwatch::hal
