// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/views/view_list.h"

#include <cstdio>

#include "app/pictures/colour_maps.h"
#include "app/ports/web/streams/picture_sizes.h"

namespace orbwatch::app::web {
namespace {

/// Number of colours, enough for invisible steps.
constexpr std::size_t kStops = 18;

SentColourMap sent_map(std::string_view name) {
  const remap::ColourMap::Table table = colour_map_table(name);
  SentColourMap map{std::string(name), {}};
  for (std::size_t n = 0; n < kStops; ++n) {
    const auto& [red, green, blue] = table[n * (table.size() - 1) / (kStops - 1)];
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", red, green, blue);
    map.stops.emplace_back(text);
  }
  return map;
}

SentView sent_view(const std::string& name, std::size_t index, const PublishedView& view,
                   const std::optional<Aim>& aim) {
  SentView sent;
  sent.name = name;
  sent.index = index;
  sent.width = view.spec.width;
  sent.height = view.spec.height;
  sent.widths = widths_of(sent.width);
  sent.is_measured = view.measured;
  sent.is_pointed = !view.measured && view.spec.kind != optics::ViewKind::Ball;
  sent.is_zoomed = sent.is_pointed && view.spec.kind == optics::ViewKind::Perspective;
  sent.is_mixed = view.mixes;
  if (aim) sent.aim = sent_aim(*aim);
  sent.configured = sent_aim({view.spec});
  for (const PublishedSource& source : view.sources) {
    sent.sources.push_back({source.camera,
                            source.is_radiometric,
                            {source.colour_map, source.range},
                            source.is_radiometric ? "degC" : "%"});
  }
  return sent;
}

}  // namespace

ViewList::ViewList(const WebContext& context)
    : names_(context.names.views), views_(context.views), aims_(names_.size()) {}

void ViewList::accept(const View& view) {
  const std::lock_guard lock(mutex_);
  if (view.index < aims_.size()) aims_[view.index] = aim_of(view);
}

std::optional<Command> ViewList::at_present(const Command& command) const {
  const std::size_t view = command.integer(0);
  const std::lock_guard lock(mutex_);
  if (view >= aims_.size() || !aims_[view]) return std::nullopt;
  return web::at_present(command, *aims_[view]);
}

Answered<ViewsAnswer> ViewList::list() const {
  // Allocated before locking, so that the pipeline's thread does not wait for it.
  std::vector<std::optional<Aim>> aims(names_.size());
  {
    const std::lock_guard lock(mutex_);
    aims = aims_;
  }
  ViewsAnswer answer;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    answer.views.push_back(sent_view(names_[i], i, views_[i], aims[i]));
  }
  for (const std::string_view name : kColourMapNames) answer.colour_maps.push_back(sent_map(name));
  return answer;
}

}  // namespace orbwatch::app::web
