// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/interfaces.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "app/daemon/recordings/recorded_regions.h"
#include "app/daemon/replay/replay_desk.h"
#include "app/daemon/site/published.h"
#include "app/daemon/site/recorded_cameras.h"
#include "app/model/fleet/appliance_notice.h"
#include "app/model/fleet/fleet.h"
#include "app/ports/web/web_context.h"

namespace orbwatch::app::daemon {
namespace {

/// Parts that sinks are made with; each sink takes those that its make_sink() names.
using SinkParts = std::tuple<StatusNames, std::vector<PublishedView>, std::vector<PublishedCamera>,
                             CommandPath, MachinePath, RecordedTexts, std::vector<RecordedCamera>,
                             std::shared_ptr<hal::SharedThreads>, std::shared_ptr<Fleet>,
                             ApplianceIdentity, PageContext>;

/// Null: the settings do not enable it.
template <class Settings, class... Parts>
std::unique_ptr<Sink> made(std::unique_ptr<Sink> (*make)(const Settings&, const Parts&...),
                           const Settings& settings, const SinkParts& parts) {
  constexpr bool kTakesCommands = (std::is_same_v<Parts, CommandPath> || ...);
  static_assert(
      !kTakesCommands || requires { commanders(settings); },
      "an interface that takes commands needs commanders()");
  return make(settings, std::get<Parts>(parts)...);
}

/// Null: no events are recorded.
std::shared_ptr<RecordedEvents> make_events(const files::SinkSettings& sinks) {
  std::shared_ptr<RecordedEvents> events;
  files::for_each_sink(sinks, [&events](const auto& settings) {
    if constexpr (requires { recorded_events(settings); }) events = recorded_events(settings);
  });
  return events;
}

/// Null: no events are recorded.
std::shared_ptr<RecordedExports> make_exports(const files::SinkSettings& sinks) {
  std::shared_ptr<RecordedExports> exports;
  files::for_each_sink(sinks, [&exports](const auto& settings) {
    if constexpr (requires { recorded_exports(settings); }) exports = recorded_exports(settings);
  });
  return exports;
}

/// Null: no events are recorded.
std::shared_ptr<RecordedReplays> make_replays(const std::shared_ptr<RecordedEvents>& events,
                                              const files::Resolved& site) {
  if (!events) return nullptr;
  RecipeTexts recipes;
  for (const files::RecipeFile& recipe : site.site.recipes) {
    const auto text = site.texts.find(recipe.file.path);
    if (text != site.texts.end()) recipes[recipe.number] = text->second;
  }
  return std::make_shared<ReplayDesk>(events, std::move(recipes),
                                      ReplayLimits{.free_memory = free_memory});
}

PageContext page_context(const files::Resolved& site, const SitePlan& plan,
                         AlignmentSource* alignment, Program program) {
  const std::shared_ptr<RecordedEvents> events = make_events(site.site.sinks);
  return {.ball = plan.scene.ball,
          .scene = plan.scene.proxy,
          .balls = camera_balls(site),
          .recipes = measured_recipes(site, plan),
          .alignment = alignment,
          .events = events,
          .regions = recorded_regions,
          .exports = make_exports(site.site.sinks),
          .replays = make_replays(events, site),
          .state_folder = site.state_folder,
          .program = std::move(program)};
}

/// Address of the appliance's page for other computers.
PageAddress page_of(const files::SinkSettings& sinks) {
  PageAddress page;
  files::for_each_sink(sinks, [&page](const auto& settings) {
    if constexpr (requires { page_address(settings); }) page = page_address(settings);
  });
  return page;
}

/// Null: there is nobody to receive from, or nobody to show it to.
std::shared_ptr<Fleet> make_fleet(const files::SinkSettings& sinks) {
  bool is_filled = false, is_shown = false;
  files::for_each_sink(sinks, [&](const auto& settings) {
    if constexpr (requires { fills_fleet(settings); }) is_filled |= fills_fleet(settings);
    if constexpr (requires { shows_fleet(settings); }) is_shown |= shows_fleet(settings);
  });
  return is_filled && is_shown ? std::make_shared<Fleet>() : nullptr;
}

}  // namespace

std::string commanders_text(const files::SinkSettings& sinks) {
  std::string text;
  const auto add = [&text](const std::string& commanders) {
    if (!commanders.empty()) text += (text.empty() ? "" : "; ") + commanders;
  };
  files::for_each_sink(sinks, [&add](const auto& settings) {
    if constexpr (requires { commanders(settings); }) add(commanders(settings));
  });
  return "takes commands " + (text.empty() ? "from nobody" : text);
}

Interfaces::Interfaces(const files::Resolved& site, const SitePlan& plan, CommandPath commands,
                       MachinePath machine, std::shared_ptr<hal::SharedThreads> background,
                       AlignmentSource* alignment, Program program) {
  const files::SinkSettings& sinks = site.site.sinks;
  ApplianceIdentity identity;
  identity.version = version_of(program);
  identity.page = page_of(sinks);
  RecordedTexts texts = recorded_texts(site, program);
  PageContext page = page_context(site, plan, alignment, std::move(program));
  page.tables = [this] { return tables(); };
  page.metrics = [this] { return metrics(); };
  const SinkParts parts{site.names,
                        published_views(site, plan),
                        published_cameras(site),
                        std::move(commands),
                        std::move(machine),
                        std::move(texts),
                        recorded_cameras(site, plan.formats),
                        std::move(background),
                        make_fleet(sinks),
                        std::move(identity),
                        std::move(page)};
  std::size_t next = 0;
  files::for_each_sink(sinks, [&]<class Settings>(const Settings& settings) {
    all_[next++] = made<Settings>(make_sink, settings, parts);
  });
}

void Interfaces::start(Attempts& attempts, hal::TimePoint now) {
  for (std::size_t i = 0; i < all_.size(); ++i) {
    if (!all_[i]) continue;
    const auto attempt = [this, i] {
      return all_[i]->start().map([this, i] { started_ |= 1U << i; });
    };
    attempts.add(std::string(kInterfaceNames[i]), attempt, now);
  }
}

void Interfaces::stop() {
  for (Sink* sink : sinks()) sink->stop();
}

std::vector<Sink*> Interfaces::sinks() const {
  std::vector<Sink*> sinks;
  for (const auto& sink : all_) {
    if (sink) sinks.push_back(sink.get());
  }
  return sinks;
}

std::vector<InterfaceTable> Interfaces::tables() const {
  std::vector<InterfaceTable> all;
  for (const Sink* sink : sinks()) std::ranges::move(sink->tables(), std::back_inserter(all));
  return all;
}

std::vector<InterfaceMetric> Interfaces::metrics() const {
  std::vector<InterfaceMetric> all;
  for (const Sink* sink : sinks()) std::ranges::move(sink->metrics(), std::back_inserter(all));
  return all;
}

std::uint32_t Interfaces::faults() const {
  std::uint32_t faults = 0;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const bool works = !all_[i] || ((started_ >> i & 1U) != 0 && all_[i]->works());
    faults |= (works ? 0U : 1U) << i;
  }
  return faults;
}

}  // namespace orbwatch::app::daemon
