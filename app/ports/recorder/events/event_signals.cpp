// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_signals.h"

#include "app/ports/recorder/recorded_states.h"
#include "app/ports/recorder/recorded_utc.h"

namespace orbwatch::app::recorder {
namespace {

Result<std::shared_ptr<const SignalSteps>> read_signals(const std::filesystem::path& recording) {
  auto states = RecordedStates::open(recording);
  if (!states) return tl::unexpected(states.error());
  const auto steps = std::make_shared<SignalSteps>();
  while (true) {
    const auto state = states->next();
    if (!state) return tl::unexpected(state.error());
    if (!*state) break;
    if (auto added = steps->add(**state); !added) {
      return fail(recording.string() + ": " + added.error().message);
    }
  }
  if (states->count() == 0) {
    return fail(recording.string() + ": no state of the process, so no frame set");
  }
  return steps;
}

}  // namespace

Result<std::shared_ptr<const SignalSteps>> EventSignals::read(
    const std::filesystem::path& recording) {
  const std::lock_guard lock(mutex_);
  if (steps_ && recording_ == recording) return steps_;
  steps_.reset();
  auto steps = read_signals(recording);
  if (!steps) return steps;
  recording_ = recording;
  steps_ = *steps;
  return steps;
}

Result<std::vector<RecordedSignal>> EventSignals::list(const std::filesystem::path& recording) {
  return read(recording).map([](const std::shared_ptr<const SignalSteps>& steps) {
    std::vector<RecordedSignal> signals;
    for (const SignalSteps::Course& course : steps->courses()) signals.push_back(course.signal);
    return signals;
  });
}

Result<std::vector<RecordedRecipeChange>> EventSignals::recipes(
    const std::filesystem::path& recording) {
  return read(recording).map([](const std::shared_ptr<const SignalSteps>& steps) {
    std::vector<RecordedRecipeChange> changes;
    for (const auto& [utc, recipe] : steps->recipes())
      changes.push_back({utc_text_at(utc), recipe});
    return changes;
  });
}

Result<RecordedCourse> EventSignals::course(const std::filesystem::path& recording,
                                            const std::string& region, const std::string& figure) {
  const auto steps = read(recording);
  if (!steps) return tl::unexpected(steps.error());
  return course_in(**steps, region, figure);
}

}  // namespace orbwatch::app::recorder
