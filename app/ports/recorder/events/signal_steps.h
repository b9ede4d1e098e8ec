// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/model/sink/recorded_events.h"
#include "app/ports/recorder/recorded_states.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Signals of the regions and of the machine over a recording, in steps of so many frame sets in
/// succession that there are at most kMostSteps: one at first, then 2, 4 ... Bounded whatever the
/// recording has: 16 MiB. Thread-bound.
class SignalSteps {
 public:
  static constexpr std::size_t kMostSteps = 2048, kMostSignals = 512;

  /// First frame set of a step.
  struct Step {
    std::uint64_t utc = 0;  ///< ns since 1970
    std::uint64_t frame_set = 0;
  };
  /// First frame set by another recipe.
  struct RecipeChange {
    std::uint64_t utc = 0;  ///< ns since 1970
    std::uint16_t recipe = 0;
  };
  /// Lowest and highest values by step; NaN: not valid in any of its frame sets.
  struct Course {
    RecordedSignal signal;
    std::vector<double> low, high;
  };

  /// Appends a frame set. Values that are not numbers, such as the name of the part, are left out.
  /// Errors: more than kMostSignals; a region's name that is too long.
  Result<> add(const RecordedState& recorded);

  const std::vector<Step>& steps() const { return steps_; }
  /// In the order in which they were valid first.
  const std::vector<Course>& courses() const { return courses_; }
  /// Recipes in their order, at most kMostSteps.
  const std::vector<RecipeChange>& recipes() const { return recipes_; }
  /// Null: no such signal has been a number.
  const Course* find(const std::string& region, const std::string& figure) const;

 private:
  void begin_step(const Step& step);
  void halve();
  Result<Course*> course_of(const ComponentFigures& component, const Figure& figure);

  std::size_t sets_ = 0, sets_per_step_ = 1;
  std::vector<Step> steps_;
  std::vector<Course> courses_;
  std::vector<RecipeChange> recipes_;
  std::map<std::pair<std::string, std::string>, std::size_t> places_;  ///< by region and figure
};

/// A signal with the times of its steps. Error: there is no such signal. Reentrant.
Result<RecordedCourse> course_in(const SignalSteps& steps, const std::string& region,
                                 const std::string& figure);

}  // namespace orbwatch::app::recorder
