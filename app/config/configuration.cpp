#include "app/config/configuration.h"

#include <algorithm>

#include "app/config/plain_names.h"
#include "app/config/schema.h"
#include "app/config/text_file.h"
#include "app/config/toml_reader.h"

namespace orbwatch::app {
namespace {

template <class Named>
const Named* by_name(const std::vector<Named>& list, const std::string& name) {
  const auto it =
      std::find_if(list.begin(), list.end(), [&](const Named& n) { return n.name == name; });
  return it == list.end() ? nullptr : &*it;
}

template <class Named>
std::string names(const std::vector<Named>& list) {
  std::string text;
  for (const Named& item : list) text += (text.empty() ? "" : ", ") + item.name;
  return text;
}

void check_camera(const CameraSettings& camera, const optics::Rig& rig, Finding& finding) {
  const optics::RigCamera* known = by_name(rig.cameras, camera.name);
  if (!known) {
    finding.note(camera.line, "camera.name",
                 "the rig has no camera \"" + camera.name + "\"; it has: " + names(rig.cameras));
    return;
  }
  const std::string rig_size = ", but the rig is for " + std::to_string(known->width) + "x" +
                               std::to_string(known->height) + " pictures";
  if (camera.width && camera.width != known->width) {
    finding.note(camera.line, "camera.width", std::to_string(camera.width) + rig_size);
  }
  if (camera.height && camera.height != known->height) {
    finding.note(camera.line, "camera.height", std::to_string(camera.height) + rig_size);
  }
}

/// Whether `name` is a line that triggers.
void check_source(int line, const char* key, const std::string& name,
                  const Configuration& configuration, Finding& finding) {
  const LineSettings* source = by_name(configuration.lines, name);
  if (source && source->use == LineUse::TriggerIn) return;
  finding.note(line, key,
               "there is no line \"" + name +
                   "\" with use trigger_in; lines: " + names(configuration.lines));
}

void check_view(const ViewSettings& view, const Configuration& configuration, Finding& finding) {
  if (view.name == "selected") {
    finding.note(view.line, "view.name", "\"selected\" is the topic of the selected view");
  }
  const optics::ViewSpec spec{view.kind,  {view.yaw, view.pitch, view.roll},
                              view.h_fov, view.v_fov,
                              view.width, view.height};
  if (const auto possible = optics::check_view(spec); !possible) {
    finding.note(view.line, "view", possible.error().message);
  }
  for (const SourceSettings& source : view.sources) {
    if (!by_name(configuration.cameras, source.camera)) {
      finding.note(source.line, "view.source.camera",
                   "there is no camera \"" + source.camera +
                       "\"; there are: " + names(configuration.cameras));
    }
  }
}

void check_process(const ProcessSettings& process, const Configuration& configuration,
                   Finding& finding) {
  const ViewSettings* view = by_name(configuration.views, process.view);
  if (!view) {
    finding.note(
        process.line, "process.view",
        "there is no view \"" + process.view + "\"; there are: " + names(configuration.views));
    return;
  }
  const bool has_camera = std::any_of(view->sources.begin(), view->sources.end(),
                                      [&](const auto& s) { return s.camera == process.camera; });
  if (!has_camera) {
    finding.note(process.line, "process.camera",
                 "the view \"" + view->name + "\" has no camera \"" + process.camera + "\"");
  }
}

void check_references(const Configuration& configuration, Finding& finding) {
  check_names(configuration.cameras, "camera", finding);
  check_names(configuration.views, "view", finding);
  check_names(configuration.lines, "line", finding);
  for (const LineSettings& line : configuration.lines) {
    if (line.source.empty()) continue;
    check_source(line.line, "line.source", line.source, configuration, finding);
  }
  for (const CameraSettings& camera : configuration.cameras) {
    check_camera(camera, configuration.rig, finding);
    if (camera.trigger_source.empty()) continue;
    check_source(camera.line, "camera.trigger_source", camera.trigger_source, configuration,
                 finding);
  }
  for (const ViewSettings& view : configuration.views) check_view(view, configuration, finding);
  if (configuration.process) check_process(*configuration.process, configuration, finding);
}

}  // namespace

Result<Configuration> parse_configuration(const std::string& text, const std::string& name,
                                          const std::filesystem::path& folder) {
  Finding finding{name, folder, std::nullopt, false};
  Configuration configuration;
  read_toml(text, configuration, finding);
  if (!finding.message) check_references(configuration, finding);
  if (finding.message) return fail(*finding.message);
  return configuration;
}

Result<Configuration> load_configuration(const std::filesystem::path& file) {
  return read_text_file(file, "a TOML file").and_then([&](const std::string& text) {
    return parse_configuration(text, file.string(), file.parent_path());
  });
}

}  // namespace orbwatch::app
