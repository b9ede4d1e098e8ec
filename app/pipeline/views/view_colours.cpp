// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/view_colours.h"

#include <utility>

#include "app/pipeline/views/source_colours.h"

namespace orbwatch::app::pipeline {

ViewColours::ViewColours(std::span<const ViewPlan> views, std::vector<remap::ColourMap::Table> maps)
    : maps_(std::move(maps)), slots_(views.size()) {
  for (std::size_t view = 0; view < views.size(); ++view) {
    for (const ViewSource& source : views[view].sources) {
      slots_[view].sources.push_back({source.format, source.colours});
    }
  }
}

/// `change` turns the colours that were asked for last into those of this request.
template <class Change>
CommandResult ViewColours::request(std::size_t view, std::size_t source, const Change& change) {
  const std::lock_guard one_at_a_time(requesting_);
  if (view >= slots_.size() || source >= slots_[view].sources.size()) {
    return CommandResult::ArgumentOutOfRange;
  }
  Source& asked = slots_[view].sources[source];
  if (info(asked.format.format).colour != ColourModel::Luminance) return CommandResult::NotPossible;
  change(asked.colours);
  asked.is_chosen = true;
  make(slots_[view], source);
  return CommandResult::Done;
}

CommandResult ViewColours::set_map(std::size_t view, std::size_t source, std::size_t map) {
  if (map >= maps_.size()) return CommandResult::ArgumentOutOfRange;
  return request(view, source, [map](SourceColours& colours) { colours.map = map; });
}

CommandResult ViewColours::set_range(std::size_t view, std::size_t source,
                                     const std::array<double, 2>& range) {
  if (!(range[0] < range[1])) return CommandResult::ArgumentOutOfRange;
  return request(view, source, [&range](SourceColours& colours) { colours.range = range; });
}

void ViewColours::adopt(std::size_t view, std::span<const ViewSource> sources) {
  const std::lock_guard one_at_a_time(requesting_);
  Slot& slot = slots_[view];
  for (std::size_t i = 0; i < sources.size(); ++i) {
    slot.sources[i].format = sources[i].format;
    if (slot.sources[i].is_chosen) make(slot, i);
  }
}

void ViewColours::make(Slot& slot, std::size_t source) {
  const auto& [format, colours, is_chosen] = slot.sources[source];
  auto made = std::make_unique<const ShownColours>(
      ShownColours{colours, make_colour_map(maps_[colours.map], colours.range, format)});
  const std::lock_guard lock(mutex_);
  std::swap(slot.waiting[source], made);  // what it replaces is freed after the lock
  slot.is_new[source] = true;
}

ChosenColours ViewColours::exchange(std::size_t view) {
  Slot& slot = slots_[view];
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < slot.in_use.size(); ++i) {
    if (std::exchange(slot.is_new[i], false)) std::swap(slot.waiting[i], slot.in_use[i]);
  }
  return slot.in_use;
}

}  // namespace orbwatch::app::pipeline
