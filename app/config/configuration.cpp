#include "app/config/configuration.h"

#include <zlib.h>

#include <algorithm>
#include <set>

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

/// What can only be said of a view when the cameras are known.
void check_sources(const ViewSettings& view, const Configuration& configuration, Finding& finding) {
  if (view.name == "selected") {
    finding.note(view.line, "view.name", "\"selected\" is the topic of the selected view");
  }
  for (const SourceSettings& source : view.sources) {
    if (!by_name(configuration.cameras, source.camera)) {
      finding.note(source.line, "view.source.camera",
                   "there is no camera \"" + source.camera +
                       "\"; there are: " + names(configuration.cameras));
    }
  }
}

void check_views(const Configuration& configuration, Finding& finding) {
  check_names(configuration.views, "view", finding);
  for (const ViewSettings& view : configuration.views) {
    if (const auto possible = optics::check_view(view.spec()); !possible) {
      finding.note(view.line, "view", possible.error().message);
    }
    check_sources(view, configuration, finding);
  }
}

std::ptrdiff_t count(const Recipe& recipe, const CameraControlSettings& control) {
  return std::ranges::count_if(recipe.controls, [&](const CameraControlSettings& other) {
    return other.camera == control.camera && other.name == control.name;
  });
}

/// What one recipe sets all must set, or it would depend on the one before. And it stands nowhere
/// else: what would hold then depends on the order.
void check_control(const CameraControlSettings& control, const Configuration& configuration,
                   Finding& finding) {
  const CameraSettings* camera = by_name(configuration.cameras, control.camera);
  if (!camera) {
    finding.note(control.line, "control.camera",
                 "there is no camera \"" + control.camera +
                     "\"; there are: " + names(configuration.cameras));
    return;
  }
  const std::string what = control.camera + "'s " + control.name;
  if (by_name(camera->controls, control.name)) {
    finding.note(control.line, "control.name",
                 what + " is set by the configuration already; it must stand in one of them");
  }
  for (const RecipeSettings& other : configuration.recipes) {
    const auto times = count(other.recipe, control);
    if (times == 1) continue;
    finding.note(control.line, "control.name",
                 "recipe " + std::to_string(other.number) +
                     (times == 0 ? " does not set " : " sets twice ") + what +
                     "; every recipe must, once");
  }
}

/// What a recipe says about cameras, lines and views of the configuration. Its lines count in its
/// own file.
void check_recipe(const Recipe& recipe, const Configuration& configuration, Finding& finding) {
  for (const MeasuredViewSettings& view : recipe.views) {
    if (by_name(configuration.views, view.name)) {
      finding.note(view.line, "view.name",
                   "\"" + view.name + "\" is a view of the configuration already");
    }
    check_sources(view, configuration, finding);
  }
  for (const CameraControlSettings& control : recipe.controls) {
    check_control(control, configuration, finding);
  }
  if (recipe.process_active != ActiveSource::Input) return;
  const LineSettings* input = by_name(configuration.lines, recipe.process_input);
  if (!input || input->use != LineUse::ProcessInput) {
    finding.note(1, "process_input",
                 "there is no line \"" + recipe.process_input +
                     "\" with use process_input; lines: " + names(configuration.lines));
  }
}

void check_recipes(const Configuration& configuration, Finding& finding) {
  std::set<int> numbers;
  for (const RecipeSettings& settings : configuration.recipes) {
    if (!numbers.insert(settings.number).second) {
      finding.note(settings.line, "recipe.number",
                   std::to_string(settings.number) + " is there twice");
    }
    Finding own{settings.file.string(), {}, std::nullopt, false};
    check_recipe(settings.recipe, configuration, own);
    if (own.message && !finding.message) finding.message = own.message;
  }
  const std::size_t views = view_names(configuration).size();
  if (views == 0 || views > kMaxViews) {
    finding.note(1, "view",
                 std::to_string(views) + " are given, those of the recipes included; 1 to " +
                     std::to_string(kMaxViews) + " are allowed");
  }
}

void check_references(const Configuration& configuration, Finding& finding) {
  check_names(configuration.cameras, "camera", finding);
  check_names(configuration.lines, "line", finding);
  for (const LineSettings& line : configuration.lines) {
    if (line.name == kSoftwareSource) {
      finding.note(line.line, "line.name", "\"software\" is the trigger_source of commands");
    }
    if (line.source.empty()) continue;
    check_source(line.line, "line.source", line.source, configuration, finding);
  }
  for (const CameraSettings& camera : configuration.cameras) {
    check_camera(camera, configuration.rig, finding);
    if (camera.trigger_source.empty() || camera.trigger_source == kSoftwareSource) continue;
    check_source(camera.line, "camera.trigger_source", camera.trigger_source, configuration,
                 finding);
  }
  check_views(configuration, finding);
  check_recipes(configuration, finding);
}

/// Of files that were just read: one that cannot be read any more does not count.
std::uint32_t checksum(const std::string& text, const Configuration& configuration) {
  const auto add = [](std::uint32_t sum, const std::string& bytes) {
    return static_cast<std::uint32_t>(
        crc32_z(sum, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  };
  std::uint32_t sum = add(0, text);
  auto files = rig_files(configuration.rig_file);
  for (const RecipeSettings& recipe : configuration.recipes) files.push_back(recipe.file);
  for (const auto& file : files) sum = add(sum, read_text_file(file, "a text file").value_or(""));
  return sum;
}

}  // namespace

Result<Configuration> parse_configuration(const std::string& text, const std::string& name,
                                          const std::filesystem::path& folder) {
  Finding finding{name, folder, std::nullopt, false};
  Configuration configuration;
  read_toml(text, configuration, finding);
  if (!finding.message) check_references(configuration, finding);
  if (finding.message) return fail(*finding.message);
  configuration.checksum = checksum(text, configuration);
  return configuration;
}

std::vector<std::string> view_names(const Configuration& configuration) {
  std::vector<std::string> names;
  for (const ViewSettings& view : configuration.views) names.push_back(view.name);
  for (const RecipeSettings& settings : configuration.recipes) {
    for (const ViewSettings& view : settings.recipe.views) {
      if (std::ranges::find(names, view.name) == names.end()) names.push_back(view.name);
    }
  }
  return names;
}

Result<Configuration> load_configuration(const std::filesystem::path& file) {
  return read_text_file(file, "a TOML file").and_then([&](const std::string& text) {
    return parse_configuration(text, file.string(), file.parent_path());
  });
}

}  // namespace orbwatch::app
