// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/alarm_board.h"

#include <optional>
#include <string>

namespace orbwatch::signals {
namespace {

/// The event of a step, if there is one.
std::optional<AlarmEventKind> change(const Alarm& before, const Alarm& after, bool suppressed) {
  if (suppressed) {
    const bool stood = before.state != AlarmState::Normal && after != before;
    return stood ? std::optional(AlarmEventKind::Suppressed) : std::nullopt;
  }
  if (is_raised(before, after)) return AlarmEventKind::Raised;
  if (after.level == before.level) return std::nullopt;
  return after.level == AlarmLevel::None ? AlarmEventKind::Cleared : AlarmEventKind::Eased;
}

double value_of(const AlarmLimits& limits, std::span<const Signals> regions) {
  if (limits.region >= regions.size()) return kNotValid;
  return regions[limits.region].*kSignals[limits.signal].member;
}

}  // namespace

Result<AlarmBoard> AlarmBoard::make(std::span<const AlarmLimits> limits, std::size_t region_count) {
  if (limits.size() > kMaxAlarms) {
    return fail(std::to_string(limits.size()) + " alarms are too many: at most " +
                std::to_string(kMaxAlarms));
  }
  AlarmBoard board;
  for (const AlarmLimits& one : limits) {
    std::string where = "alarm " + std::to_string(board.size_);
    if (one.signal < kSignals.size()) {
      where += " (" + std::string(kSignals[one.signal].name) + ")";
    }
    if (auto checked = check(one); !checked) return fail(where + ": " + checked.error().message);
    if (one.region >= region_count) {
      return fail(where + ": region " + std::to_string(one.region) + " does not exist: there are " +
                  std::to_string(region_count));
    }
    board.limits_[board.size_++] = one;
  }
  return board;
}

std::span<const AlarmEvent> AlarmBoard::step(const AlarmBoardInputs& inputs) {
  event_count_ = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    const AlarmInputs now{inputs.now, value_of(limits_[i], inputs.regions), inputs.process_active,
                          !inputs.stale[limits_[i].region]};
    if (inputs.acknowledged[i]) acknowledge(i, now);
    step(i, now);
  }
  return {events_.data(), event_count_};
}

void AlarmBoard::acknowledge(std::size_t index, const AlarmInputs& now) {
  AlarmMemory& memory = memories_[index];
  const Alarm before = memory.alarm;
  memory = signals::acknowledge(limits_[index], memory);
  if (memory.alarm.state == before.state) return;
  record(index, AlarmEventKind::Acknowledged, before.announced, now);
}

void AlarmBoard::step(std::size_t index, const AlarmInputs& now) {
  AlarmMemory& memory = memories_[index];
  const Alarm before = memory.alarm;
  memory = signals::step(limits_[index], memory, now);
  const auto kind = change(before, memory.alarm, is_suppressed(limits_[index], now));
  if (!kind) return;
  const bool begins = *kind == AlarmEventKind::Raised || *kind == AlarmEventKind::Eased;
  record(index, *kind, begins ? memory.alarm.level : before.announced, now);
}

void AlarmBoard::record(std::size_t index, AlarmEventKind kind, AlarmLevel level,
                        const AlarmInputs& now) {
  events_[event_count_++] = {index, kind, memories_[index].alarm.state, level, now.value, now.now};
}

}  // namespace orbwatch::signals
