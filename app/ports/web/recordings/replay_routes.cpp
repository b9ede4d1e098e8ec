// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/recordings/replay_routes.h"

#include <string>

#include "app/ports/web/recordings/recording_routes.h"

namespace orbwatch::app::web {
namespace {

constexpr const char* kNoReplays = "no events are recorded: set [recorder.events]";

}  // namespace

void ReplayRoutes::start() const {
  if (replays_) replays_->start();
}

void ReplayRoutes::stop() const {
  if (replays_) replays_->stop();
}

std::chrono::nanoseconds ReplayRoutes::cpu_time() const {
  return replays_ ? replays_->cpu_time() : std::chrono::nanoseconds(0);
}

Answered<ReplayStatus> ReplayRoutes::status() const {
  return replays_ ? replays_->status() : ReplayStatus{};
}

Answered<ReplayResult> ReplayRoutes::result(const ReplayNumber& query) const {
  if (!replays_) return refuse(404, kNoReplays);
  const auto result = replays_->result(query.number);
  if (!result) return refuse(404, result.error().message);
  return **result;
}

Answered<RecordedCourse> ReplayRoutes::signal(const ReplaySignalQuery& query) const {
  if (!replays_) return refuse(404, kNoReplays);
  auto course = replays_->course(query.number, query.region, query.figure);
  if (!course) return refuse(404, course.error().message);
  return std::move(*course);
}

Answered<ReplayNumber> ReplayRoutes::begin(Change<ReplayBody>& change) const {
  const std::uint16_t recipe = change.body.recipe.value_or(selected_());
  change.after = event_for_audit(change.body.event) + " recipe " + std::to_string(recipe);
  if (!replays_) return refuse(404, kNoReplays);
  const auto begun = replays_->begin({change.body.event, recipe, change.caller.name});
  if (!begun) return refuse(begun.error());
  return ReplayNumber{*begun};
}

Answered<Done> ReplayRoutes::cancel(Change<ReplayNumber>& change) const {
  if (!replays_) return refuse(404, kNoReplays);
  const ReplayStatus status = replays_->status();
  change.before = status.event;
  if (status.user != change.caller.name && change.caller.role < Role::Operator) {
    return refuse(
        403, "the replay is that of " + status.user + "; the role operator is needed to cancel it");
  }
  const auto cancelled = replays_->cancel(change.body.number);
  if (!cancelled) return refuse(cancelled.error());
  return Done{};
}

}  // namespace orbwatch::app::web
