// SPDX-License-Identifier: Apache-2.0
#include "app/files/resolve.h"

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "app/files/plain_names.h"
#include "app/files/recipe/recipe_file.h"
#include "app/files/rig/rig_file.h"
#include "app/files/runtime/calibration_file.h"
#include "app/files/text/text_file.h"
#include "app/files/toml/toml_reader.h"
#include "app/pipeline/views/picture_use.h"
#include "app/state/state_folder.h"

namespace orbwatch::app::files {
namespace {

template <class Named>
std::vector<std::string> names(const std::vector<Named>& list) {
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const Named& item : list) names.push_back(item.name);
  return names;
}

template <class Named>
std::string joined_names(const std::vector<Named>& list) {
  std::string text;
  for (const Named& item : list) text += (text.empty() ? "" : ", ") + item.name;
  return text;
}

template <class Named>
std::optional<std::size_t> index_of(const std::vector<Named>& list, const std::string& name) {
  const auto found = std::ranges::find(list, name, &Named::name);
  if (found == list.end()) return std::nullopt;
  return static_cast<std::size_t>(found - list.begin());
}

/// Resolves the references of one file after the other. Messages on a recipe name the recipe's
/// file, to which their lines refer.
class Resolver {
 public:
  Resolver(Resolved& resolved, Finding& finding)
      : resolved_(resolved), site_(resolved.site), finding_(finding) {}

  void run() {
    check_names(site_.cameras, "camera", finding_);
    check_names(site_.lines, "line", finding_);
    check_names(site_.views, "view", finding_);
    resolved_.names = {names(site_.cameras), names(site_.views), {}, process_inputs()};
    resolve_lines();
    resolve_events();
    resolve_cameras();
    resolve_display_views();
    resolve_recipes();
    const std::size_t views = resolved_.names.views.size();
    if (views == 0 || views > kMaxViews) {
      finding_.refuse(1, "view",
                      std::to_string(views) + " are given, those of the recipes included; 1 to " +
                          std::to_string(kMaxViews) + " are allowed");
    }
  }

 private:
  /// Checks a line that triggers.
  void check_trigger_line(int line, const char* key, const std::string& name) {
    const auto found = index_of(site_.lines, name);
    if (found && site_.lines[*found].use == LineUse::TriggerIn) return;
    finding_.refuse(line, key,
                    "there is no line \"" + name +
                        "\" with use trigger_in; lines: " + joined_names(site_.lines));
  }

  void resolve_lines() {
    for (const auto& line : site_.lines) {
      if (line.name == kSoftwareSource) {
        finding_.refuse(line.line, "line.name", "\"software\" is the trigger_source of commands");
      }
      if (!line.source.empty()) check_trigger_line(line.line, "line.source", line.source);
    }
  }

  std::vector<std::string> process_inputs() const {
    std::vector<std::string> inputs;
    for (const auto& line : site_.lines) {
      if (line.use == LineUse::ProcessInput) inputs.push_back(line.name);
    }
    return inputs;
  }

  std::string no_process_input(const std::string& name) const {
    return "there is no line \"" + name +
           "\" with use process_input; lines: " + joined_names(site_.lines);
  }

  /// Checks the lines that trigger recordings.
  void resolve_events() {
    const auto& events = std::get<RecorderSettings>(site_.sinks).events;
    if (!events) return;
    for (const std::string& name : events->on_lines) {
      if (std::ranges::find(resolved_.names.process_inputs, name) !=
          resolved_.names.process_inputs.end()) {
        continue;
      }
      finding_.refuse(events->line, "recorder.events.on_lines", no_process_input(name));
    }
  }

  void resolve_cameras() {
    resolved_.rig_cameras.clear();
    const CameraSettings* triggered = nullptr;  // the first triggered camera
    for (const auto& camera : site_.cameras) {
      const auto known = index_of(resolved_.rig.cameras, camera.name);
      if (known) {
        check_size(camera, resolved_.rig.cameras[*known], camera.line);
      } else {
        finding_.refuse(camera.line, "camera.name",
                        "the rig has no camera \"" + camera.name +
                            "\"; it has: " + joined_names(resolved_.rig.cameras));
      }
      resolved_.rig_cameras.push_back(known.value_or(0));
      if (camera.trigger_source.empty()) continue;
      if (camera.trigger_source != kSoftwareSource) {
        check_trigger_line(camera.line, "camera.trigger_source", camera.trigger_source);
      }
      if (!triggered) triggered = &camera;
      check_same_triggers(camera, *triggered, camera.line);
    }
  }

  /// Refuses other triggers than the first triggered camera's: frames are joined by the trigger's
  /// number, and every camera counts its own.
  void check_same_triggers(const CameraSettings& camera, const CameraSettings& first, int line) {
    const auto check = [&](const char* key, std::string_view own, std::string_view others) {
      if (own == others) return;
      finding_.refuse(line, key,
                      "\"" + std::string(own) + "\", but camera \"" + first.name + "\" has \"" +
                          std::string(others) +
                          "\"; it must be the same for all triggered cameras");
    };
    check("camera.trigger_source", camera.trigger_source, first.trigger_source);
    check("camera.trigger_activation", word_for(kTriggerActivations, camera.trigger.activation),
          word_for(kTriggerActivations, first.trigger.activation));
  }

  void check_size(const CameraSettings& camera, const optics::RigCamera& known, int line) {
    const std::string rig_size = ", but the rig is for " + std::to_string(known.width) + "x" +
                                 std::to_string(known.height) + " pictures";
    if (camera.stream.width && camera.stream.width != known.width) {
      finding_.refuse(line, "camera.width", std::to_string(camera.stream.width) + rig_size);
    }
    if (camera.stream.height && camera.stream.height != known.height) {
      finding_.refuse(line, "camera.height", std::to_string(camera.stream.height) + rig_size);
    }
  }

  void resolve_camera(Reference& camera, int line, const char* key, Finding& finding) {
    const auto found = index_of(site_.cameras, camera.name);
    camera.index = found.value_or(0);
    if (found) return;
    finding.refuse(
        line, key,
        "there is no camera \"" + camera.name + "\"; there are: " + joined_names(site_.cameras));
  }

  void resolve_sources(pipeline::ViewSettings& view, int line, Finding& finding) {
    if (view.name == "selected") {
      finding.refuse(line, "view.name", "\"selected\" is the topic of the selected view");
    }
    for (auto& source : view.sources) {
      resolve_camera(source.camera, source.line, "view.source.camera", finding);
      check_sharpness(source, source.line, finding);
    }
  }

  void check_sharpness(const pipeline::SourceSettings& source, int line, Finding& finding) {
    pipeline::PictureUse& use = sharpened_[source.camera.index];
    if (use.add(source.sharpness, {})) return;
    std::string known;
    for (const auto& [sharpness, area] : use.sharpened()) {
      std::ostringstream text;
      text << (known.empty() ? "" : ", ") << sharpness;
      known += text.str();
    }
    finding.refuse(
        line, "view.source.sharpness",
        "camera \"" + source.camera.name + "\" has " + std::to_string(pipeline::kMaxSharpnesses) +
            " others in views and recipes already, which is the most; use 0 or one of: " + known);
  }

  void resolve_display_views() {
    for (std::size_t i = 0; i < site_.views.size(); ++i) {
      auto& view = site_.views[i];
      if (const auto possible = optics::check_view(view.spec()); !possible) {
        finding_.refuse(view.line, "view", possible.error().message);
      }
      view.index = i;
      resolve_sources(view, view.line, finding_);
    }
  }

  void resolve_recipes() {
    std::set<int> numbers;
    for (std::size_t i = 0; i < site_.recipes.size(); ++i) {
      const std::uint16_t number = site_.recipes[i].number;
      if (!numbers.insert(number).second) {
        finding_.refuse(site_.recipes[i].line, "recipe.number",
                        std::to_string(number) + " is there twice");
      }
      Finding own{site_.recipes[i].file.path.string(), {}};
      resolve_recipe(resolved_.recipes[i], own);
      if (own.message && !finding_.message) finding_.message = own.message;
      resolved_.names.regions[number] = names(resolved_.recipes[i].regions);
    }
  }

  void resolve_recipe(pipeline::Recipe& recipe, Finding& finding) {
    for (auto& view : recipe.views) {
      if (index_of(site_.views, view.name)) {
        finding.refuse(view.line, "view.name",
                       "\"" + view.name + "\" is a view of the configuration already");
      }
      resolve_sources(view, view.line, finding);
      auto& views = resolved_.names.views;
      const auto known = std::ranges::find(views, view.name);
      view.index = static_cast<std::size_t>(known - views.begin());
      if (known == views.end()) views.push_back(view.name);
    }
    for (auto& control : recipe.controls) {
      resolve_camera(control.camera, control.line, "control.camera", finding);
      check_control(control, control.line, finding);
    }
    if (recipe.process_active == pipeline::ActiveSource::Input) {
      resolve_process_input(recipe.process_input, finding);
    }
  }

  void resolve_process_input(Reference& input, Finding& finding) {
    const auto& inputs = resolved_.names.process_inputs;
    const auto found = std::ranges::find(inputs, input.name);
    input.index = static_cast<std::size_t>(found - inputs.begin());
    if (found == inputs.end()) finding.refuse(1, "process_input", no_process_input(input.name));
  }

  /// Every recipe must set the same controls, and the configuration none of them; otherwise a
  /// camera's settings would depend on previous selections.
  void check_control(const pipeline::CameraControl& control, int line, Finding& finding) {
    const std::string what = control.camera.name + "'s " + control.name;
    const auto camera = index_of(site_.cameras, control.camera.name);
    if (camera && index_of(site_.cameras[*camera].controls, control.name)) {
      finding.refuse(line, "control.name",
                     what + " is set by the configuration already; it must stand in one of them");
    }
    for (std::size_t i = 0; i < resolved_.recipes.size(); ++i) {
      const auto times = std::ranges::count_if(
          resolved_.recipes[i].controls, [&](const pipeline::CameraControl& other) {
            return other.camera.name == control.camera.name && other.name == control.name;
          });
      if (times == 1) continue;
      finding.refuse(line, "control.name",
                     "recipe " + std::to_string(site_.recipes[i].number) +
                         (times == 0 ? " does not set " : " sets twice ") + what +
                         "; every recipe must, once");
    }
  }

  Resolved& resolved_;
  Configuration& site_;
  Finding& finding_;
  pipeline::PictureUses sharpened_;  ///< sharpenings of all views
};

/// Replaces the rig file's alignments by those accepted for this rig.
Result<> calibrate(Resolved& resolved, TextFiles& files) {
  // The texts that were read are used: the files may have changed since.
  const auto rig = rig_checksum(resolved.site.rig.path, files.texts());
  if (!rig) return tl::unexpected(rig.error());
  resolved.rig_checksum = *rig;
  const auto file = calibration_file(resolved.state_folder);
  const auto entries = load_calibrations(file, files);
  if (!entries) return tl::unexpected(entries.error());
  resolved.alignments = in_force(*entries, *rig);
  for (const CalibrationEntry& entry : resolved.alignments) {
    if (auto applied = apply(entry.alignment, resolved.rig); !applied) {
      return fail(file.string() + ": entry " + std::to_string(entry.number) +
                  " does not fit the rig: " + applied.error().message);
    }
  }
  return {};
}

Result<Resolved> resolve_with(TextFiles& files, const std::string& text, const std::string& name,
                              const std::filesystem::path& folder,
                              const std::optional<std::filesystem::path>& state = {}) {
  Finding finding{name, folder};
  Resolved resolved;
  resolved.file = folder / std::filesystem::path(name).filename();
  read_toml(text, resolved.site, finding);
  if (finding.message) return fail(*finding.message);
  auto rig = load_rig(resolved.site.rig.path, files);
  if (!rig) finding.refuse(resolved.site.rig.line, "rig", rig.error().message);
  for (const RecipeFile& settings : resolved.site.recipes) {
    auto recipe = load_recipe(settings.file.path, files);
    if (!recipe) finding.refuse(settings.file.line, "recipe.file", recipe.error().message);
    resolved.recipes.push_back(std::move(recipe).value_or(pipeline::Recipe{}));
  }
  if (finding.message) return fail(*finding.message);
  resolved.rig = std::move(*rig);
  // Empty where it is another machine's: files of this one by themselves are right.
  resolved.state_folder = state ? *state
                                : state_folder(resolved.site.state_folder, resolved.file)
                                      .value_or(std::filesystem::path());
  const bool has_state = !resolved.state_folder.empty();
  if (has_state) {
    if (auto done = calibrate(resolved, files); !done) return tl::unexpected(done.error());
  }
  if (auto done = resolve_references(resolved, name); !done) return tl::unexpected(done.error());
  resolved.checksum = files.checksum();
  resolved.texts = files.texts();
  if (!has_state) return resolved;
  const auto calibration = calibration_file(resolved.state_folder);
  resolved.calibration[calibration] = resolved.texts[calibration];
  resolved.texts.erase(calibration);
  return resolved;
}

}  // namespace

Result<> resolve_references(Resolved& resolved, const std::string& name) {
  Finding finding{name, {}};
  Resolver(resolved, finding).run();
  if (finding.message) return fail(*finding.message);
  return {};
}

Result<Configuration> read_site(const std::filesystem::path& file, const FileTexts& instead) {
  TextFiles files(instead);
  const auto text = files.read(file, "a TOML file");
  if (!text) return tl::unexpected(text.error());
  Finding finding{file.string(), file.parent_path()};
  Configuration site;
  read_toml(*text, site, finding);
  if (finding.message) return fail(*finding.message);
  return site;
}

Result<Resolved> resolve(const std::filesystem::path& file, const FileTexts& instead,
                         const std::optional<std::filesystem::path>& state_folder) {
  TextFiles files(instead);
  return files.read(file, "a TOML file").and_then([&](const std::string& text) {
    return resolve_with(files, text, file.string(), file.parent_path(), state_folder);
  });
}

Result<Resolved> resolve_text(const std::string& text, const std::string& name,
                              const std::filesystem::path& folder) {
  TextFiles files;
  files.add(text);
  return resolve_with(files, text, name, folder);
}

}  // namespace orbwatch::app::files
