#include "app/daemon/sinks.h"

#include <tuple>
#include <utility>

namespace orbwatch::app {
namespace {

SinkContext make_context(const Resolved& site, CommandHandler handler,
                         std::shared_ptr<CommandRecord> record) {
  SinkContext context{site.names, {}, {}, std::move(handler), std::move(record)};
  context.views.resize(site.names.views.size());
  const auto publish = [&context](const ViewSettings& view, bool measured) {
    const bool perspective = view.kind == optics::ViewKind::Perspective;
    context.views[view.index] = {view.encoding, perspective, measured};
  };
  for (const ViewSettings& view : site.site.views) publish(view, false);
  for (const Recipe& recipe : site.recipes) {
    for (const ViewSettings& view : recipe.views) publish(view, true);
  }
  for (const CameraSettings& camera : site.site.cameras) {
    context.camera_encodings.push_back(camera.encoding);
  }
  return context;
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

std::vector<std::unique_ptr<Sink>> make_sinks(const Resolved& site, CommandHandler handler,
                                              std::shared_ptr<CommandRecord> record) {
  const SinkContext context = make_context(site, std::move(handler), std::move(record));
  std::vector<std::unique_ptr<Sink>> sinks;
  const auto add = [&](const auto& settings) {
    if (auto sink = make_sink(settings, context)) sinks.push_back(std::move(sink));
  };
  std::apply([&add](const auto&... settings) { (add(settings), ...); }, site.site.sinks);
  return sinks;
}

}  // namespace orbwatch::app
