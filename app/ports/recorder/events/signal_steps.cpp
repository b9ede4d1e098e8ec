// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/signal_steps.h"

#include <cmath>
#include <limits>

#include "app/ports/recorder/recorded_utc.h"

namespace orbwatch::app::recorder {
namespace {

constexpr std::size_t kLongestSignal = 1024;  ///< bytes of a region's name and a figure's
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Result<> SignalSteps::add(const RecordedState& recorded) {
  const std::uint16_t recipe = recorded.state.recipe;
  const bool is_other = recipes_.empty() || recipes_.back().recipe != recipe;
  if (is_other && recipes_.size() < kMostSteps) recipes_.push_back({recorded.utc, recipe});
  if (sets_++ % sets_per_step_ == 0) begin_step({recorded.utc, recorded.state.frame_set});
  for (const ComponentFigures& component : recorded.state.components) {
    if (component.kind != "region" && component.kind != "machine") continue;
    for (const Figure& figure : component.figures) {
      if (!std::isfinite(figure.value)) continue;
      const auto course = course_of(component, figure);
      if (!course) return tl::unexpected(course.error());
      double& low = (*course)->low.back();
      double& high = (*course)->high.back();
      low = std::fmin(low, figure.value);
      high = std::fmax(high, figure.value);
    }
  }
  return {};
}

const SignalSteps::Course* SignalSteps::find(const std::string& region,
                                             const std::string& figure) const {
  const auto place = places_.find({region, figure});
  return place == places_.end() ? nullptr : &courses_[place->second];
}

void SignalSteps::begin_step(const Step& step) {
  if (steps_.size() == kMostSteps) halve();
  steps_.push_back(step);
  for (Course& course : courses_) {
    course.low.push_back(kNone);
    course.high.push_back(kNone);
  }
}

/// Joins each two steps.
void SignalSteps::halve() {
  constexpr std::size_t kHalf = kMostSteps / 2;
  sets_per_step_ *= 2;
  for (std::size_t k = 0; k < kHalf; ++k) steps_[k] = steps_[2 * k];
  steps_.resize(kHalf);
  for (Course& course : courses_) {
    for (std::size_t k = 0; k < kHalf; ++k) {
      course.low[k] = std::fmin(course.low[2 * k], course.low[2 * k + 1]);
      course.high[k] = std::fmax(course.high[2 * k], course.high[2 * k + 1]);
    }
    course.low.resize(kHalf);
    course.high.resize(kHalf);
  }
}

Result<SignalSteps::Course*> SignalSteps::course_of(const ComponentFigures& component,
                                                    const Figure& figure) {
  const std::string region = component.kind == "region" ? component.name : std::string();
  const auto [place, is_new] = places_.try_emplace({region, figure.name}, courses_.size());
  if (!is_new) return &courses_[place->second];
  if (courses_.size() == kMostSignals) {
    return fail("more than " + std::to_string(kMostSignals) + " signals");
  }
  if (region.size() + figure.name.size() + figure.unit.size() > kLongestSignal) {
    return fail("the name of a signal is longer than " + std::to_string(kLongestSignal) + " bytes");
  }
  courses_.push_back({{region, figure.name, figure.unit},
                      std::vector<double>(steps_.size(), kNone),
                      std::vector<double>(steps_.size(), kNone)});
  return &courses_.back();
}

Result<RecordedCourse> course_in(const SignalSteps& steps, const std::string& region,
                                 const std::string& figure) {
  const SignalSteps::Course* const found = steps.find(region, figure);
  if (found == nullptr) {
    return fail("the event has no signal " + figure +
                (region.empty() ? " of the machine" : " of the region " + region));
  }
  RecordedCourse course{found->signal.unit, {}, {}, found->low, found->high};
  for (const SignalSteps::Step& step : steps.steps()) {
    course.times.push_back(utc_text_at(step.utc));
    course.frame_sets.push_back(step.frame_set);
  }
  return course;
}

}  // namespace orbwatch::app::recorder
