// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/replay/comparison.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "app/daemon/replay/jpeg_tolerance.h"

namespace orbwatch::app::daemon {
namespace {

using recorder::ComponentFigures;
using recorder::Figure;
using recorder::ProcessState;

constexpr std::string_view kRegion = "region", kAlarm = "alarm";
/// Figure of an alarm: the time since it changed until it was reported.
constexpr std::string_view kSince = "since_age";
/// Figure of an alarm: the value of its signal.
constexpr std::string_view kValue = "value";

bool is_compared(const ComponentFigures& component) {
  return component.kind == kRegion || component.kind == kAlarm;
}

const ComponentFigures* component_in(const ProcessState& state, std::string_view kind,
                                     std::string_view name) {
  const auto found = std::ranges::find_if(state.components, [&](const ComponentFigures& component) {
    return component.kind == kind && component.name == name;
  });
  return found == state.components.end() ? nullptr : &*found;
}

std::optional<double> value_of(const ComponentFigures& component, std::string_view figure) {
  const auto found = std::ranges::find(component.figures, figure, &Figure::name);
  if (found == component.figures.end()) return std::nullopt;
  return found->value;
}

/// The value in a state; NaN: it has none.
double value_in(const ProcessState& state, const Difference& place) {
  const auto* const component = component_in(state, place.kind, place.name);
  if (component == nullptr) return std::nan("");
  return value_of(*component, place.figure).value_or(std::nan(""));
}

bool is_measured(const ComponentFigures& region) {
  return value_of(region, "quality") != static_cast<double>(Quality::NotMeasured);
}

}  // namespace

void Comparison::add(std::uint64_t utc, const ProcessState& recorded,
                     const ProcessState& computed) {
  settle(recorded);
  ++counts_.sets;
  for (const ComponentFigures& component : recorded.components) {
    if (!is_compared(component)) continue;
    const auto* const other = component_in(computed, component.kind, component.name);
    if (other == nullptr) {
      add_missing(component);
    } else if (component.kind == kRegion && !is_measured(component)) {
      ++counts_.not_measured;
    } else {
      compare(component, *other,
              {utc, recorded.frame_set, component.kind, component.name, {}, 0, 0, false},
              recorded.recipe);
    }
  }
  for (const ComponentFigures& component : computed.components) {
    if (is_compared(component) &&
        component_in(recorded, component.kind, component.name) == nullptr) {
      add_missing(component);
    }
  }
  before_ = recorded;
}

void Comparison::add_missing(const ComponentFigures& component) {
  if (counts_.missing.size() == ComparisonCounts::kMostMissing) return;
  counts_.missing.insert(component.kind + " " + component.name);
}

/// Compares all figures that both have, but not the time since an alarm changed.
void Comparison::compare(const ComponentFigures& recorded, const ComponentFigures& computed,
                         Difference place, std::uint16_t recipe) {
  for (const Figure& figure : recorded.figures) {
    const auto value = value_of(computed, figure.name);
    if (!value || figure.name == kSince) continue;
    ++counts_.values;
    if (is_same(figure.value, *value)) continue;
    place.figure = figure.name;
    place.recorded = figure.value;
    place.computed = *value;
    place.is_of_jpeg = is_of_jpeg(place, recipe);
    const bool is_alarm = place.kind == kAlarm;
    if (is_alarm && counts_.sets > 1 && is_same(value_in(before_, place), *value)) continue;
    if (is_alarm) {
      unsettled_.push_back(place);
    } else {
      report(place);
    }
  }
}

/// Reports the alarms of the set before that are not as in this one either.
void Comparison::settle(const ProcessState& recorded) {
  for (const Difference& difference : std::exchange(unsettled_, {})) {
    if (!is_same(value_in(recorded, difference), difference.computed)) report(difference);
  }
}

const ComparisonCounts& Comparison::finish() {
  for (const Difference& difference : std::exchange(unsettled_, {})) report(difference);
  return counts_;
}

void Comparison::report(const Difference& difference) {
  ++(difference.is_of_jpeg ? counts_.of_jpeg : counts_.differences);
  on_difference_(difference);
}

/// True: JPEG explains the difference of a region's signal, or of the value of its alarm.
bool Comparison::is_of_jpeg(const Difference& difference, std::uint16_t recipe) const {
  const std::string_view name = difference.name;
  std::string region(name);
  std::string_view signal = difference.figure;
  if (difference.kind == kAlarm) {
    // "1, pool: hot_spot_width"
    const std::size_t comma = name.find(", "), colon = name.rfind(": ");
    const bool is_value = signal == kValue && comma < colon && colon != std::string_view::npos;
    if (!is_value) return false;
    region = name.substr(comma + 2, colon - comma - 2);
    signal = name.substr(colon + 2);
  }
  const auto quality = qualities_.find({recipe, region});
  return quality != qualities_.end() &&
         is_explained_by_jpeg(signal, quality->second, difference.recorded, difference.computed);
}

bool Comparison::is_same(double recorded, double computed) const {
  if (std::isnan(recorded) || std::isnan(computed)) {
    return std::isnan(recorded) && std::isnan(computed);
  }
  const double larger = std::max(std::abs(recorded), std::abs(computed));
  return recorded == computed || std::abs(recorded - computed) <= tolerance_ * larger;
}

}  // namespace orbwatch::app::daemon
