// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "app/model/command/command.h"
#include "app/model/status/alarm_notice.h"
#include "app/model/status/status.h"
#include "app/pipeline/measurement/compiled_recipe.h"
#include "app/pipeline/measurement/recipe_switch.h"
#include "hal/lines/process_input.h"
#include "hal/sync/frame_set.h"
#include "hal/thread/priority_mutex.h"

namespace orbwatch::app::pipeline {

/// Decides which recipe is measured, which frame sets are results, whether the process is active,
/// and which alarms are raised.
/// Thread rule: commands on any thread, start and stop on the main, all else on the pipeline's.
class Measurement {
 public:
  using ProcessInputs = std::vector<std::shared_ptr<const hal::ProcessInput>>;
  using Notify = std::function<void(const AlarmNotice&)>;

  /// Starts with the first of `recipes`, which must not be empty. `apply` is null when no recipe
  /// sets a camera.
  Measurement(std::vector<std::unique_ptr<CompiledRecipe>> recipes, ProcessInputs inputs,
              RecipeSwitch::Apply apply);

  // Commands; each returns at once and takes effect with the next apply_commands().

  /// Resumes measuring after pause().
  CommandResult resume();
  /// Stops measuring; views continue.
  CommandResult pause();
  /// Selects a recipe by its number, for frame sets exposed from now on. ArgumentOutOfRange: no
  /// such recipe.
  CommandResult select_recipe(std::size_t number);
  /// Refused selection, by the recipes' numbers: see RecipeSwitch::refusal(). On any thread.
  std::optional<RecipeSwitch::Refusal> refusal() const {
    auto refused = switch_.refusal();
    if (refused) *refused = {numbers_[refused->wanted], numbers_[refused->kept]};
    return refused;
  }
  /// Makes a result of the next frame set whose measured frames are all exposed from now on; after
  /// a second without one, a result without those that are older. Busy: one is pending.
  CommandResult trigger();
  /// Acknowledges an alarm by its number, from 1; 0: all. ArgumentOutOfRange: the recipe has no
  /// such alarm.
  CommandResult acknowledge_alarm(std::size_t number, const Giver& by = {});
  /// Applies to recipes whose process_active is ActiveSource::Command.
  CommandResult set_process_active(bool active);

  /// Applies pause, resume and the selected recipe between two sets; they take effect nowhere else,
  /// so that one status never mixes two of them. `stamp`: exposure of the next set; without one,
  /// now.
  void apply_commands(hal::TimePoint stamp);

  /// Swaps in the `recipes` that are not null, by index, between two sets, and leaves its own
  /// there. They have the same alarms, which continue: a camera that connects acknowledges none.
  /// The replaced ones are needed until the next watch() has returned.
  void exchange(std::vector<std::unique_ptr<CompiledRecipe>>& recipes);

  /// Planned views of each recipe.
  std::vector<std::span<const ViewPlan>> planned_views() const;

  /// Views of the current recipe.
  std::span<ViewChannel> views() { return recipe_->views(); }

  /// Renders what is measured of a set.
  void render(const hal::FrameSet& set, const FramePyramids& pyramids, ViewBuffers& buffers,
              WorkerPool& workers);
  /// Measures in the views of the rendered set.
  void measure(const hal::FrameSet& set);
  /// Replaces render() and measure() when there is no set. `blind`: no camera delivers, or all are
  /// late.
  void idle(bool blind);

  /// Steps the alarms; called after each measure() or idle(), and at least ten times a second.
  void watch(hal::TimePoint now, const Notify& notify);

  /// Fills in the members of `status` that this class determines.
  void report(Status& status) const;

  /// State after the last apply_commands().
  bool is_paused() const { return paused_; }

  /// Sets the cameras to recipes from now on: see RecipeSwitch::start().
  void start() { switch_.start(); }
  void stop() { switch_.stop(); }

 private:
  struct Acknowledged {
    signals::AlarmSet alarms;
    std::array<Giver, signals::kMaxAlarms> by;
  };

  void change_to(CompiledRecipe& recipe);
  bool is_result(const hal::FrameSet& set);
  bool answers_command(const hal::FrameSet& set);
  void suppress_previous(hal::TimePoint now, const Notify& notify);
  void notify_of(const CompiledRecipe& recipe, const signals::AlarmEvent& event,
                 const Notify& notify, const Giver& by = {});
  Acknowledged take_acknowledged();
  /// Nullopt: the region that would decide is not measured.
  std::optional<bool> process_active() const;

  const std::vector<std::uint16_t> numbers_;  ///< numbers of recipes_, by index
  std::vector<std::unique_ptr<CompiledRecipe>> recipes_;
  const ProcessInputs inputs_;
  RecipeSwitch switch_;
  CompiledRecipe* recipe_;
  const CompiledRecipe* previous_ = nullptr;  ///< recipe that was replaced since the last watch()
  /// Selection for the newest set; nullopt: it belongs to no recipe.
  std::optional<RecipeSwitch::Selection> selection_;
  std::uint64_t changes_ = 0;  ///< camera changes for which settling has begun
  int to_settle_ = 0;          ///< remaining sets with all settings that are not measured
  bool paused_ = false;
  std::uint64_t frame_set_ = 0;
  hal::TimePoint stamp_{};
  std::uint64_t result_ = 0;  ///< number of the newest result; 0: none yet
  std::uint64_t notices_ = 0;
  bool active_ = false;  ///< last known state of the process
  std::atomic<bool> pause_requested_{false};
  std::atomic<bool> commanded_active_{false};
  std::atomic<std::size_t> alarm_count_;  ///< number of alarms of the recipe
  hal::PriorityMutex acknowledging_;      ///< guards acknowledged_, held for a copy only
  Acknowledged acknowledged_;             ///< acknowledgements since the last watch()
  /// Time of the pending trigger command on hal::Clock; 0: none is pending.
  std::atomic<hal::Clock::rep> trigger_{0};
};

}  // namespace orbwatch::app::pipeline
