// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/history/figure_history.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

namespace orbwatch::app::web {
namespace {

/// Place of a figure among the fields of a part.
struct FigurePlace {
  std::size_t index;
  std::string_view unit;
};

template <class Part>
std::optional<FigurePlace> find_field(std::string_view name) {
  std::optional<FigurePlace> found;
  std::size_t index = 0;
  for_each_field(std::type_identity<Part>{}, [&](const FieldInfo& field) {
    if (field.name == name) found = FigurePlace{index, field.unit};
    ++index;
  });
  return found;
}

template <class Part>
std::vector<std::string_view> field_names() {
  std::vector<std::string_view> names;
  for_each_field(std::type_identity<Part>{},
                 [&](const FieldInfo& field) { names.push_back(field.name); });
  return names;
}

constexpr std::string_view kRegionKind = "region", kCameraKind = "camera";

std::optional<FigurePlace> find_figure(std::string_view kind, std::string_view name) {
  return kind == kRegionKind ? find_field<RegionStatus>(name) : find_field<CameraWatchStatus>(name);
}

}  // namespace

void FigureHistory::accept(const Status& status) {
  const std::lock_guard lock(adding_);
  open_.add(status);
}

void FigureHistory::begin(hal::TimePoint now) {
  const std::lock_guard lock(reading_);
  end_ = now;
}

void FigureHistory::advance(hal::TimePoint now) {
  if (end_ == hal::TimePoint{}) begin(now);
  if (now < end_ + kStep) return;
  StatusExtremes seen;
  {
    const std::lock_guard lock(adding_);
    std::swap(seen, open_);
  }
  const std::lock_guard lock(reading_);
  follow(seen);
  end_step(seen);
  end_ += kStep;
  end_gap(now);
}

/// Ends all steps that are over by `now`, without measurements.
void FigureHistory::end_gap(hal::TimePoint now) {
  const auto over = static_cast<std::size_t>((now - end_) / kStep);
  const StatusExtremes nothing;
  for (std::size_t gap = 0; gap < std::min(over, kSteps); ++gap) end_step(nothing);
  end_ += kStep * over;
}

void FigureHistory::resume(const std::vector<Kept>& kept, hal::TimePoint end, hal::TimePoint now) {
  const std::lock_guard lock(reading_);
  end_ = end;
  for (const auto& [component, figures] : kept) {
    const bool is_region = component.kind == kRegionKind;
    Track track{{is_region ? kRegionKind : kCameraKind, component.name},
                std::vector<Extremes>(figure_names(component.kind).size() * kSteps)};
    for (const auto& [name, steps] : figures) {
      count_ = std::max(count_, steps.size());
      const auto place = find_figure(component.kind, name);
      if (!place) continue;
      std::ranges::copy(steps,
                        track.steps.begin() + static_cast<std::ptrdiff_t>(place->index * kSteps));
    }
    tracks_.push_back(std::move(track));
  }
  next_ = count_ % kSteps;
  end_gap(now);
}

std::vector<std::string_view> FigureHistory::figure_names(std::string_view kind) {
  return kind == kRegionKind ? field_names<RegionStatus>() : field_names<CameraWatchStatus>();
}

/// Adapts the tracks to the regions and cameras seen; keeps them if there was no status.
void FigureHistory::follow(const StatusExtremes& seen) {
  if (seen.region_count + seen.camera_count == 0) return;
  std::vector<Track> next;
  next.reserve(seen.region_count + seen.camera_count);
  for (std::size_t i = 0; i < seen.region_count; ++i) {
    follow(next, {kRegionKind, name_or_number(names_.region(seen.recipe, i), i)},
           seen.regions[i].size());
  }
  for (std::size_t i = 0; i < seen.camera_count; ++i) {
    follow(next, {kCameraKind, name_or_number(names_.camera(i), i)}, seen.cameras[i].size());
  }
  tracks_ = std::move(next);
}

void FigureHistory::follow(std::vector<Track>& next, Component component, std::size_t figures) {
  const auto found = std::ranges::find(tracks_, component, &Track::component);
  if (found != tracks_.end()) {
    next.push_back(std::move(*found));
  } else {
    next.push_back({std::move(component), std::vector<Extremes>(figures * kSteps)});
  }
}

void FigureHistory::end_step(const StatusExtremes& seen) {
  std::size_t region = 0, camera = 0;
  for (Track& track : tracks_) {
    const std::span<const Extremes> figures = track.component.kind == kRegionKind
                                                  ? std::span(seen.regions[region++])
                                                  : std::span(seen.cameras[camera++]);
    for (std::size_t i = 0; i < figures.size(); ++i) track.steps[i * kSteps + next_] = figures[i];
  }
  next_ = (next_ + 1) % kSteps;
  count_ = std::min(count_ + 1, kSteps);
}

bool FigureHistory::is_configured(const Component& component) const {
  const auto has = [&component](const std::vector<std::string>& names) {
    return std::ranges::find(names, component.name) != names.end();
  };
  if (component.kind == kCameraKind) return has(names_.cameras);
  return std::ranges::any_of(names_.regions,
                             [&](const auto& recipe) { return has(recipe.second); });
}

std::optional<FigureHistory::Series> FigureHistory::series(const Component& component,
                                                           std::string_view figure) const {
  const auto place = find_figure(component.kind, figure);
  if (!place) return std::nullopt;
  Series series{place->unit, {}, {}};
  const std::lock_guard lock(reading_);
  const auto track = std::ranges::find(tracks_, component, &Track::component);
  if (track == tracks_.end()) {
    return is_configured(component) ? std::optional(series) : std::nullopt;
  }
  series.end = end_;
  series.steps.reserve(count_);
  const auto ring = std::span(track->steps).subspan(place->index * kSteps, kSteps);
  for (std::size_t i = 0; i < count_; ++i) {
    series.steps.push_back(ring[(next_ + kSteps - count_ + i) % kSteps]);
  }
  return series;
}

std::vector<Component> FigureHistory::components() const {
  const std::lock_guard lock(reading_);
  std::vector<Component> all;
  std::ranges::transform(tracks_, std::back_inserter(all), &Track::component);
  return all;
}

}  // namespace orbwatch::app::web
