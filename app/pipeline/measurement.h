#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/commands.h"
#include "app/pipeline/compiled_recipe.h"
#include "app/pipeline/recipe_switch.h"
#include "app/pipeline/status.h"
#include "app/pipeline/view.h"
#include "app/pipeline/worker_pool.h"
#include "hal/frame_set.h"
#include "hal/lines/process_input.h"

namespace orbwatch::app {

/// What the pipeline measures: by which recipe, whether the process runs, which frame sets are
/// results, what alarms there are.
/// Thread rule: command on any thread, stop on the main, all else on the pipeline's.
class Measurement {
 public:
  using ProcessInputs = std::vector<std::shared_ptr<const hal::ProcessInput>>;
  /// Takes a rendered view to the sinks; null: they hold every buffer of it.
  using Publish = std::function<void(std::size_t view, const std::shared_ptr<View>&)>;
  using Notify = std::function<void(const AlarmNotice&)>;

  /// By the first of `recipes`, at least one. `apply`: none when no recipe sets a camera.
  Measurement(std::vector<std::unique_ptr<CompiledRecipe>> recipes, ProcessInputs inputs,
              RecipeSwitch::Apply apply);

  /// Start, stop, select_recipe, trigger, acknowledge_alarm, set_process_active.
  CommandResult command(const Command& command);

  /// Renders and measures a set, then hands the views over.
  void process(const hal::FrameSet& set, WorkerPool& workers, const Publish& publish);
  /// No set came: the recipe may change all the same. `blind`: no camera delivers.
  void idle(bool blind);

  /// Watches the limits; called after each process() or idle(), and at least ten times a second.
  /// What stood in a recipe that was left is suppressed.
  void watch(hal::TimePoint now, const Notify& notify);

  /// Fills in the members of `status` that are known here.
  void report(Status& status) const;

  /// Since the newest set, or when there was none then.
  bool is_stopped() const { return stopped_; }

  void stop() { switch_.stop(); }

 private:
  void take_commands(hal::TimePoint stamp);
  void change_to(CompiledRecipe& recipe);
  bool is_result(const hal::FrameSet& set);
  void suppress_left(hal::TimePoint now, const Notify& notify);
  void notify_of(const CompiledRecipe& recipe, const signals::AlarmEvent& event,
                 const Notify& notify);
  bool process_active() const;
  CommandResult select_recipe(std::size_t number);
  CommandResult trigger();
  CommandResult acknowledge(std::size_t number);

  const std::vector<std::unique_ptr<CompiledRecipe>> recipes_;
  const ProcessInputs inputs_;
  RecipeSwitch switch_;
  CompiledRecipe* recipe_;
  const CompiledRecipe* left_ = nullptr;  ///< since the last watch(); null: none
  /// Of the newest set; nothing: it belongs to no recipe.
  std::optional<RecipeSwitch::Selection> selection_;
  std::uint64_t changes_ = 0;  ///< of the cameras that were settled for
  int to_settle_ = 0;          ///< sets that do not count yet
  bool stopped_ = false;
  std::uint64_t frame_set_ = 0;
  hal::TimePoint stamp_{};
  std::uint64_t results_ = 0;
  std::uint64_t notices_ = 0;
  bool active_ = false;
  std::vector<std::shared_ptr<View>> rendered_;
  std::atomic<bool> measuring_{true};
  std::atomic<bool> commanded_active_{false};
  std::atomic<std::size_t> alarm_count_;        ///< of the recipe
  std::atomic<std::uint32_t> acknowledged_{0};  ///< bit n: alarm n, since the last watch()
  /// Since when a trigger commanded waits for the next set, of hal::Clock; 0: none does.
  std::atomic<hal::Clock::rep> trigger_{0};
};

}  // namespace orbwatch::app
