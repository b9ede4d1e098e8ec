#include "app/daemon/interfaces.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "app/daemon/published.h"
#include "app/model/fleet.h"

namespace orbwatch::app {
namespace {

SinkContext make_context(const Resolved& site, const SitePlan& plan, CommandHandler handler,
                         std::shared_ptr<CommandRecord> record,
                         std::shared_ptr<hal::SharedThreads> background, AlignmentSource* alignment,
                         Program program) {
  SinkContext context;
  context.names = site.names;
  context.handler = std::move(handler);
  context.record = std::move(record);
  context.background = std::move(background);
  context.state_folder = site.site.state_folder;
  context.alignment = alignment;
  context.program = std::move(program);
  context.recipes = measured_recipes(site, plan);
  context.ball = plan.scene.ball;
  context.scene = plan.scene.proxy;
  context.views = published_views(site, plan);
  context.cameras = published_cameras(site);
  return context;
}

/// Who is heard over DDS, for the page.
std::shared_ptr<Fleet> make_fleet(const SinkSettings& sinks) {
  const bool is_wanted =
      std::get<DdsSettings>(sinks).enabled && std::get<WebSettings>(sinks).enabled;
  return is_wanted ? std::make_shared<Fleet>() : nullptr;
}

/// Where other computers reach the page.
PageAddress page_of(const WebSettings& web) {
  const auto port = https_port_of(web);
  if (!web.enabled || !port || web::is_loopback(web.address)) return {};
  return {web.address, static_cast<std::uint16_t>(*port)};
}

}  // namespace

std::string commanders_text(const SinkSettings& sinks) {
  std::string text;
  const auto add = [&text](const std::string& commanders) {
    if (!commanders.empty()) text += (text.empty() ? "" : "; ") + commanders;
  };
  std::apply([&add](const auto&... settings) { (add(commanders(settings)), ...); }, sinks);
  return "takes commands " + (text.empty() ? "from nobody" : text);
}

Interfaces::Interfaces(const Resolved& site, const SitePlan& plan, CommandHandler handler,
                       std::shared_ptr<CommandRecord> record,
                       std::shared_ptr<hal::SharedThreads> background, SnapshotSink* snapshots,
                       AlignmentSource* alignment, Program program) {
  SinkContext context = make_context(site, plan, std::move(handler), std::move(record),
                                     std::move(background), alignment, std::move(program));
  context.tables = [this] { return tables(); };
  context.metrics = [this] { return metrics(); };
  context.page = page_of(std::get<WebSettings>(site.site.sinks));
  context.fleet = make_fleet(site.site.sinks);
  std::size_t next = 0;
  std::apply(
      [&](const auto&... settings) { ((made_[next++] = make_sink(settings, context)), ...); },
      site.site.sinks);
  for (std::size_t i = 0; i < kMade; ++i) all_[i < kSnapshotBit ? i : i + 1] = made_[i].get();
  all_[kSnapshotBit] = snapshots;
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
  std::ranges::copy_if(all_, std::back_inserter(sinks), [](const Sink* sink) { return sink; });
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

}  // namespace orbwatch::app
