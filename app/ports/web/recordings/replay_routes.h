// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

#include "app/ports/web/api/changes.h"
#include "app/ports/web/api/record.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/recordings/recording_records.h"
#include "app/ports/web/recordings/replay_records.h"

namespace orbwatch::app::web {

/// Serves replays of the recorder's events with a recipe, which run while it runs. Thread rule:
/// start and stop by one owner; everything else on any thread.
class ReplayRoutes {
 public:
  /// `replays` null: no events are recorded. `selected` returns the number of the selected recipe,
  /// on any thread.
  ReplayRoutes(std::shared_ptr<RecordedReplays> replays, std::function<std::uint16_t()> selected)
      : replays_(std::move(replays)), selected_(std::move(selected)) {}

  void start() const;
  void stop() const;
  std::chrono::nanoseconds cpu_time() const;

  /// Without a recorder, as before the first replay.
  Answered<ReplayStatus> status() const;
  Answered<ReplayResult> result(const ReplayNumber& query) const;
  Answered<RecordedCourse> signal(const ReplaySignalQuery& query) const;
  Answered<ReplayNumber> begin(Change<ReplayBody>& change) const;
  /// Replays of others are cancelled by operators.
  Answered<Done> cancel(Change<ReplayNumber>& change) const;

 private:
  const std::shared_ptr<RecordedReplays> replays_;
  const std::function<std::uint16_t()> selected_;
};

}  // namespace orbwatch::app::web
