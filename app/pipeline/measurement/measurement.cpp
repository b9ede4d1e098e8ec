// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/measurement/measurement.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "app/model/status/result_number.h"

namespace orbwatch::app::pipeline {
namespace {

/// Longest wait of a commanded trigger for a frame of each measured camera.
constexpr auto kTriggerWait = std::chrono::seconds(1);

std::vector<std::uint16_t> numbers_of(const std::vector<std::unique_ptr<CompiledRecipe>>& recipes) {
  std::vector<std::uint16_t> numbers;
  numbers.reserve(recipes.size());
  for (const auto& recipe : recipes) numbers.push_back(recipe->plan().number);
  return numbers;
}

}  // namespace

Measurement::Measurement(std::vector<std::unique_ptr<CompiledRecipe>> recipes, ProcessInputs inputs,
                         RecipeSwitch::Apply apply)
    : numbers_(numbers_of(recipes)),
      recipes_(std::move(recipes)),
      inputs_(std::move(inputs)),
      switch_(0, std::move(apply)),
      recipe_(recipes_.front().get()),
      alarm_count_(recipe_->plan().alarms.size()) {}

CommandResult Measurement::resume() {
  pause_requested_ = false;
  return CommandResult::Done;
}

CommandResult Measurement::pause() {
  pause_requested_ = true;
  return CommandResult::Done;
}

CommandResult Measurement::set_process_active(bool active) {
  commanded_active_ = active;
  return CommandResult::Done;
}

CommandResult Measurement::select_recipe(std::size_t number) {
  const auto found = std::ranges::find(numbers_, number);
  if (found == numbers_.end()) return CommandResult::ArgumentOutOfRange;
  switch_.request(static_cast<std::size_t>(found - numbers_.begin()));
  return CommandResult::Done;
}

CommandResult Measurement::trigger() {
  hal::Clock::rep none = 0;
  const bool is_first = trigger_.compare_exchange_strong(
      none, std::max<hal::Clock::rep>(1, hal::Clock::now().time_since_epoch().count()));
  return is_first ? CommandResult::Done : CommandResult::Busy;
}

CommandResult Measurement::acknowledge_alarm(std::size_t number, const Giver& by) {
  const std::size_t count = alarm_count_;
  if (number > count) return CommandResult::ArgumentOutOfRange;
  const std::lock_guard lock(acknowledging_);
  for (std::size_t i = 0; i < count; ++i) {
    if (number != 0 && i != number - 1) continue;
    acknowledged_.alarms.set(i);
    acknowledged_.by[i] = by;
  }
  return CommandResult::Done;
}

std::vector<std::span<const ViewPlan>> Measurement::planned_views() const {
  std::vector<std::span<const ViewPlan>> views;
  for (const auto& recipe : recipes_) views.emplace_back(recipe->plan().views);
  return views;
}

void Measurement::apply_commands(hal::TimePoint stamp) {
  paused_ = pause_requested_;
  selection_ = switch_.selection_at(stamp);
  if (!selection_) return;
  CompiledRecipe& selected = *recipes_[selection_->recipe];
  const bool is_another = &selected != recipe_;
  if (is_another) change_to(selected);
  // Settling also restarts when a refusal set the cameras back to the same recipe.
  if (std::exchange(changes_, selection_->changes) != selection_->changes || is_another) {
    to_settle_ = selected.plan().settle_frames;
  }
}

void Measurement::exchange(std::vector<std::unique_ptr<CompiledRecipe>>& recipes) {
  for (std::size_t i = 0; i < recipes_.size(); ++i) {
    if (!recipes[i]) continue;
    std::swap(recipes_[i], recipes[i]);
    if (recipe_ != recipes[i].get()) continue;
    recipe_ = recipes_[i].get();
    recipe_->continue_alarms(*recipes[i]);
  }
}

void Measurement::change_to(CompiledRecipe& recipe) {
  previous_ = std::exchange(recipe_, &recipe);
  recipe.begin();
  alarm_count_ = recipe.plan().alarms.size();
}

void Measurement::render(const hal::FrameSet& set, const FramePyramids& pyramids,
                         ViewBuffers& buffers, WorkerPool& workers) {
  recipe_->render(set, pyramids, buffers, workers);
}

void Measurement::measure(const hal::FrameSet& set) {
  frame_set_ = set.id;
  stamp_ = set.stamp;
  const bool is_settling = selection_ && to_settle_ > 0;
  to_settle_ -= is_settling && recipe_->is_set(selection_->set_since) ? 1 : 0;
  if (selection_ && !is_settling && !paused_) {
    recipe_->measure(selection_->set_since);
  } else {
    recipe_->skip();
  }
  if (is_result(set)) result_ = next_result(result_);
}

void Measurement::idle(bool blind) {
  if (blind || paused_) recipe_->skip();
}

/// True if the set is a result. Every triggered set is one, even when nothing could be measured,
/// because the sender of the trigger waits for it.
bool Measurement::is_result(const hal::FrameSet& set) {
  const bool is_commanded = answers_command(set);
  if (is_commanded) trigger_ = 0;
  return is_commanded || set.trigger.has_value();
}

/// True if the set answers the pending trigger command. A frame that was exposed before it, held
/// from an earlier set, may show the part before: the set waits for a newer one. A set with a
/// trigger of its own does not: the pacing camera has changed since the command, and the command
/// triggered the new one.
bool Measurement::answers_command(const hal::FrameSet& set) {
  const hal::Clock::rep since = trigger_;
  if (since == 0) return false;
  const hal::TimePoint given{hal::Clock::duration(since)};
  if (set.stamp < given) return false;
  if (set.trigger || recipe_->is_exposed_since(given)) return true;
  if (set.stamp < given + kTriggerWait) return false;
  recipe_->skip_exposed_before(given);
  return true;
}

std::optional<bool> Measurement::process_active() const {
  if (paused_) return false;
  switch (recipe_->plan().process_active) {
    case ActiveSource::Always:
      return true;
    case ActiveSource::Input:
      return inputs_[recipe_->plan().process_input]->active();
    case ActiveSource::Command:
      return commanded_active_;
    case ActiveSource::Detected:
      return recipe_->has_hot_spot();
  }
  return false;
}

void Measurement::watch(hal::TimePoint now, const Notify& notify) {
  if (frame_set_ == 0) stamp_ = now;
  suppress_previous(now, notify);
  const std::optional<bool> active = process_active();
  active_ = active.value_or(active_);
  // If it is unknown, alarms are active: a lost measurement must raise its alarm, not clear it.
  const bool is_watched = active.value_or(true);
  const Acknowledged acknowledged = take_acknowledged();
  for (const signals::AlarmEvent& event : recipe_->watch(now, is_watched, acknowledged.alarms)) {
    const bool is_given = event.kind == signals::AlarmEventKind::Acknowledged;
    notify_of(*recipe_, event, notify, is_given ? acknowledged.by[event.alarm] : Giver());
  }
}

Measurement::Acknowledged Measurement::take_acknowledged() {
  const std::lock_guard lock(acknowledging_);
  return std::exchange(acknowledged_, {});
}

/// Suppresses the alarms of a recipe that is no longer selected: without a last notice they would
/// stay raised in every log of notices.
void Measurement::suppress_previous(hal::TimePoint now, const Notify& notify) {
  const CompiledRecipe* previous = std::exchange(previous_, nullptr);
  if (!previous) return;
  for (std::size_t i = 0; i < previous->alarms().size(); ++i) {
    const auto& [alarm, region, signal, value, since] = previous->alarms()[i];
    if (!is_active(alarm.state) && !awaits_acknowledgement(alarm.state)) continue;
    notify_of(*previous,
              {i, signals::AlarmEventKind::Suppressed, signals::AlarmState::SuppressedByDesign,
               alarm.announced, value, now.time_since_epoch()},
              notify);
  }
}

void Measurement::notify_of(const CompiledRecipe& recipe, const signals::AlarmEvent& event,
                            const Notify& notify, const Giver& by) {
  const AlarmStatus& alarm = recipe.alarms()[event.alarm];
  notify({++notices_, event, alarm.region, alarm.signal, recipe.plan().number, frame_set_, stamp_,
          by});
}

void Measurement::report(Status& status) const {
  status.result = result_;
  status.recipe = recipe_->plan().number;
  status.recipe_refused = switch_.has_failed();
  status.process_active = active_;
  status.region_count = recipe_->regions().size();
  status.regions.fill({});
  std::ranges::copy(recipe_->regions(), status.regions.begin());
  status.alarm_count = recipe_->alarms().size();
  status.alarms.fill({});
  std::ranges::copy(recipe_->alarms(), status.alarms.begin());
}

}  // namespace orbwatch::app::pipeline
