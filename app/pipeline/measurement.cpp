#include "app/pipeline/measurement.h"

#include <algorithm>
#include <utility>

namespace orbwatch::app {

Measurement::Measurement(std::vector<std::unique_ptr<CompiledRecipe>> recipes, ProcessInputs inputs,
                         RecipeSwitch::Apply apply)
    : recipes_(std::move(recipes)),
      inputs_(std::move(inputs)),
      switch_(0, std::move(apply)),
      recipe_(recipes_.front().get()),
      alarm_count_(recipe_->plan().alarms.size()) {
  rendered_.reserve(kMaxViews);
}

CommandResult Measurement::command(const Command& command) {
  switch (command.code) {
    case CommandCode::Start:
    case CommandCode::Stop:
      measuring_ = command.code == CommandCode::Start;
      return CommandResult::Done;
    case CommandCode::SelectRecipe:
      return select_recipe(whole(command, 0));
    case CommandCode::Trigger:
      return trigger();
    case CommandCode::AcknowledgeAlarm:
      return acknowledge(whole(command, 0));
    case CommandCode::SetProcessActive:
      commanded_active_ = command.arguments[0] > 0;
      return CommandResult::Done;
    default:
      return CommandResult::UnknownCommand;
  }
}

CommandResult Measurement::select_recipe(std::size_t number) {
  for (std::size_t i = 0; i < recipes_.size(); ++i) {
    if (recipes_[i]->plan().number != number) continue;
    switch_.request(i);
    return CommandResult::Done;
  }
  return CommandResult::ArgumentOutOfRange;
}

CommandResult Measurement::trigger() {
  hal::Clock::rep none = 0;
  const bool free = trigger_.compare_exchange_strong(
      none, std::max<hal::Clock::rep>(1, hal::Clock::now().time_since_epoch().count()));
  return free ? CommandResult::Done : CommandResult::Busy;
}

CommandResult Measurement::acknowledge(std::size_t number) {
  if (number > alarm_count_) return CommandResult::ArgumentOutOfRange;
  acknowledged_ |= number == 0 ? ~0U : 1U << (number - 1);
  return CommandResult::Done;
}

void Measurement::process(const hal::FrameSet& set, WorkerPool& workers, const Publish& publish) {
  take_commands(set.stamp);
  frame_set_ = set.id;
  stamp_ = set.stamp;
  for (std::size_t n = 0; n < recipe_->plan().views.size(); ++n) {
    rendered_.push_back(recipe_->render(n, set, workers));
  }
  const bool settling = selection_ && to_settle_ > 0;
  to_settle_ -= settling ? 1 : 0;
  if (selection_ && !settling && !stopped_) {
    recipe_->measure(selection_->set_since);
  } else {
    recipe_->skip();
  }
  if (is_result(set)) ++results_;
  for (std::size_t n = 0; n < rendered_.size(); ++n) {
    publish(recipe_->plan().views[n].index, rendered_[n]);
  }
  rendered_.clear();
}

void Measurement::idle(bool blind) {
  take_commands(hal::Clock::now());
  if (blind || stopped_) recipe_->skip();
}

/// Here, between two sets, and nowhere else, so that all of a status belongs together.
void Measurement::take_commands(hal::TimePoint stamp) {
  stopped_ = !measuring_;
  selection_ = switch_.of(stamp);
  if (!selection_) return;
  CompiledRecipe& due = *recipes_[selection_->recipe];
  const bool is_another = &due != recipe_;
  if (is_another) change_to(due);
  // Also when the cameras went back to what they were set to before.
  if (std::exchange(changes_, selection_->changes) != selection_->changes || is_another) {
    to_settle_ = due.plan().settle_frames;
  }
}

void Measurement::change_to(CompiledRecipe& recipe) {
  left_ = std::exchange(recipe_, &recipe);
  recipe.begin();
  alarm_count_ = recipe.plan().alarms.size();
}

/// Every triggered set is one, also when nothing could be measured: who triggered waits for it. A
/// trigger commanded waits for a set without one of its own.
bool Measurement::is_result(const hal::FrameSet& set) {
  if (set.trigger) return true;
  const hal::Clock::rep since = trigger_;
  const bool commanded = since != 0 && set.stamp.time_since_epoch().count() >= since;
  if (commanded) trigger_ = 0;
  return commanded;
}

bool Measurement::process_active() const {
  if (stopped_) return false;
  switch (recipe_->plan().process_active) {
    case ActiveSource::Always:
      return true;
    case ActiveSource::Input:
      return inputs_[recipe_->plan().process_input]->state().active;
    case ActiveSource::Command:
      return commanded_active_;
    case ActiveSource::Detected:
      return recipe_->has_hot_spot();
  }
  return false;
}

void Measurement::watch(hal::TimePoint now, const Notify& notify) {
  if (frame_set_ == 0) stamp_ = now;
  suppress_left(now, notify);
  active_ = process_active();
  const signals::AlarmSet acknowledged(acknowledged_.exchange(0));
  for (const signals::AlarmEvent& event : recipe_->watch(now, active_, acknowledged)) {
    notify_of(*recipe_, event, notify);
  }
}

/// Nobody watches the alarms of a recipe that is not measured: what was raised must not be left
/// standing for those who keep books of notices.
void Measurement::suppress_left(hal::TimePoint now, const Notify& notify) {
  const CompiledRecipe* left = std::exchange(left_, nullptr);
  if (!left) return;
  for (std::size_t i = 0; i < left->alarms().size(); ++i) {
    const auto& [alarm, region, signal, value, since] = left->alarms()[i];
    if (!is_active(alarm.state) && !awaits_acknowledgement(alarm.state)) continue;
    notify_of(*left,
              {i, signals::AlarmEventKind::Suppressed, signals::AlarmState::SuppressedByDesign,
               alarm.announced, value, now.time_since_epoch()},
              notify);
  }
}

void Measurement::notify_of(const CompiledRecipe& recipe, const signals::AlarmEvent& event,
                            const Notify& notify) {
  const AlarmStatus& alarm = recipe.alarms()[event.alarm];
  notify({++notices_, event, alarm.region, alarm.signal, recipe.plan().number, frame_set_, stamp_});
}

void Measurement::report(Status& status) const {
  status.result = results_;
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

}  // namespace orbwatch::app
