#include "app/config/configuration.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "app/config/schema.h"
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

/// Names are parts of topics and file names.
bool is_plain_name(const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), plain) &&
         std::isalpha(static_cast<unsigned char>(name.front())) && name.back() != '_' &&
         name.find("__") == std::string::npos;
}

template <class Named>
void check_names(const std::vector<Named>& list, const std::string& key, Finding& finding) {
  std::set<std::string> seen;
  for (const Named& item : list) {
    if (!is_plain_name(item.name)) {
      finding.note(item.line, key + ".name",
                   "\"" + item.name +
                       "\" is not allowed; it must be letters, digits and single _, "
                       "a letter first");
    }
    if (!seen.insert(item.name).second) {
      finding.note(item.line, key + ".name", "\"" + item.name + "\" is there twice");
    }
  }
}

void check_view(const ViewSettings& view, const Configuration& configuration, Finding& finding) {
  if (view.name == "selected") {
    finding.note(view.line, "view.name", "\"selected\" is the topic of the selected view");
  }
  const optics::ViewSpec spec{view.kind,  {view.yaw, view.pitch, view.roll},
                              view.h_fov, view.v_fov,
                              view.width, view.height};
  if (const auto projection = optics::ViewProjection::make(spec); !projection) {
    finding.note(view.line, "view", projection.error().message);
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
  for (const ViewSettings& view : configuration.views) check_view(view, configuration, finding);
  if (configuration.process) check_process(*configuration.process, configuration, finding);
}

}  // namespace

optics::Mat3 registration(const BallSettings& ball) {
  if (ball.rotation_matrix) {
    const Numbers9& m = *ball.rotation_matrix;
    return {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}};
  }
  const Numbers3 angles = ball.rotation.value_or(Numbers3{});
  return optics::rotation({angles[0], angles[1], angles[2]});
}

Result<Configuration> parse_configuration(const std::string& text, const std::string& name,
                                          const std::filesystem::path& folder) {
  Finding finding{name, folder, std::nullopt, false};
  Configuration configuration;
  try {
    const toml::table table = toml::parse(text, name);
    TomlReader reader(table, "", finding);
    visit(reader, configuration);
    reader.refuse_unknown_keys();
  } catch (const toml::parse_error& error) {
    return fail(name + ":" + std::to_string(error.source().begin.line) +
                ": not valid TOML: " + std::string(error.description()));
  }
  if (!finding.message) check_references(configuration, finding);
  if (finding.message) return fail(*finding.message);
  return configuration;
}

Result<Configuration> load_configuration(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf())) {
    return fail(file.string() + ": cannot be read; it must be a TOML file");
  }
  return parse_configuration(text.str(), file.string(), file.parent_path());
}

}  // namespace orbwatch::app
