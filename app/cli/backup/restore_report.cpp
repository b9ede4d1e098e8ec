// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/restore_report.h"

#include <nlohmann/json.hpp>

#include "app/model/plain_text.h"

namespace orbwatch::app::cli::backup {
namespace {

using Json = nlohmann::ordered_json;

std::string camera_note(const RestoredCamera& camera) {
  return "camera " + camera.name + ": " + camera.key + " = " + camera.address + "; --camera " +
         camera.name + "=ADDRESS sets another";
}

Json all_shown(const std::vector<std::string>& texts) {
  Json list = Json::array();
  for (const std::string& text : texts) list.push_back(shown(text));
  return list;
}

}  // namespace

std::string shown(const std::string& text) {
  constexpr std::size_t kLongest = 4096;
  return plain_text(text, kLongest);
}

std::string restore_text(const Backup& backup, const Restoration& restoration) {
  const Manifest& manifest = backup.manifest;
  std::string text = "backup of " + shown(manifest.host) + ", " + shown(manifest.made) +
                     ", orbwatch " + shown(manifest.version) + "\n" + changes_text(restoration);
  if (backup.secrets.empty()) {
    for (const std::string& name : manifest.secret_files) {
      text += "not restored, a secret: " + shown(name) + "\n";
    }
  }
  for (const std::string& line : manifest.left_out) {
    text += "not in the backup: " + shown(line) + "\n";
  }
  for (const RestoredCamera& camera : restoration.cameras) {
    text += "depends on the device: " + shown(camera_note(camera)) + "\n";
  }
  for (const std::string& note : restoration.device_notes) {
    text += "depends on the device: " + shown(note) + "\n";
  }
  return text;
}

std::string restore_json(const Backup& backup, const Restoration& restoration) {
  const Manifest& manifest = backup.manifest;
  Json changes = Json::array(), cameras = Json::array();
  for (const FileChange& change : changes_of(restoration)) {
    changes.push_back({{"file", shown(change.name)}, {"change", change.word}});
  }
  for (const RestoredCamera& camera : restoration.cameras) {
    cameras.push_back({{"name", shown(camera.name)},
                       {"key", shown(camera.key)},
                       {"address", shown(camera.address)}});
  }
  const Json all{
      {"host", shown(manifest.host)},
      {"made", shown(manifest.made)},
      {"version", shown(manifest.version)},
      {"changes", std::move(changes)},
      {"not_restored", backup.secrets.empty() ? all_shown(manifest.secret_files) : Json::array()},
      {"left_out", all_shown(manifest.left_out)},
      {"cameras", std::move(cameras)},
      {"notes", all_shown(restoration.device_notes)}};
  return all.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace orbwatch::app::cli::backup
