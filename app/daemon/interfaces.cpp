#include "app/daemon/interfaces.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "app/daemon/build.h"
#include "app/model/fleet.h"

namespace orbwatch::app {
namespace {

/// As PublishedView has it. Null for other views; what the rig makes impossible, build() refuses.
std::shared_ptr<const optics::ViewProjection> ball_of(const Resolved& site,
                                                      const ViewSettings& view) {
  if (view.kind != optics::ViewKind::Ball) return nullptr;
  const SourceSettings& source = view.sources.front();
  const auto ball = optics::ball_projection(site.rig, site.rig_camera(source.camera.index));
  if (!ball) return nullptr;
  auto projection = optics::ViewProjection::make(view.spec(), *ball);
  if (!projection) return nullptr;
  return std::make_shared<const optics::ViewProjection>(std::move(*projection));
}

PublishedSource published(const Resolved& site, const SourceSettings& source) {
  const CameraSettings& camera = site.site.cameras[source.camera.index];
  return {camera.name, source.colour_map, range_of(source), camera.radiometry.is_radiometric()};
}

/// As a measured view.
PublishedView published(const Resolved& site, const ViewSettings& view) {
  PublishedView published_view;
  published_view.encoding = view.encoding;
  published_view.spec = view.spec();
  published_view.ball = ball_of(site, view);
  for (const SourceSettings& source : view.sources) {
    published_view.sources.push_back(published(site, source));
  }
  return published_view;
}

SinkContext make_context(const Resolved& site, CommandHandler handler,
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
  // Files that make an impossible scene or recipe were refused by build().
  context.recipes = measured_recipes(site).value_or(std::vector<MeasuredRecipe>());
  context.ball = site.rig.ball;
  context.scene =
      optics::SceneProxy::make(site.rig.scene, site.rig.ball).value_or(optics::SceneProxy());
  context.views.resize(site.names.views.size());
  for (const ViewSettings& view : site.site.views) {
    PublishedView& display = context.views[view.index];
    display = published(site, view);
    display.measured = false;
    display.is_own_picture = view.kind == optics::ViewKind::Ball && view.sources.size() == 1;
    display.mixes = view.combine != Combine::Switch && view.sources.size() > 1;
  }
  for (const Recipe& recipe : site.recipes) {
    for (const ViewSettings& view : recipe.views) context.views[view.index] = published(site, view);
  }
  for (std::size_t i = 0; i < site.site.cameras.size(); ++i) {
    context.cameras.push_back({site.site.cameras[i].encoding, site.rig_camera(i).intrinsics});
  }
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

Interfaces::Interfaces(const Resolved& site, CommandHandler handler,
                       std::shared_ptr<CommandRecord> record,
                       std::shared_ptr<hal::SharedThreads> background, SnapshotSink* snapshots,
                       AlignmentSource* alignment, Program program) {
  SinkContext context = make_context(site, std::move(handler), std::move(record),
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
