// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/restoration.h"

#include <algorithm>
#include <system_error>
#include <utility>
#include <variant>

#include "app/files/camera_edit.h"
#include "app/files/resolve.h"
#include "app/state/state_folder.h"
#include "hal/host.h"
#include "hal/network.h"
#include "hal/regular_file.h"

namespace orbwatch::app::cli::backup {
namespace {

namespace fs = std::filesystem;

std::string name_in_file(const files::BackEndSettings& back_end) {
  return std::visit([](const auto& settings) { return std::string(settings.kName); }, back_end);
}

/// The files of a backup, those of the site under the name that `config` has, that one first.
Result<Archive> renamed_files(const Backup& backup, const fs::path& config) {
  Archive files = backup.files;
  files.insert(files.end(), backup.secrets.begin(), backup.secrets.end());
  const auto site = std::ranges::find(files, std::string(kConfiguration) + backup.manifest.site,
                                      &ArchivedFile::name);
  if (site == files.end()) return fail("has no configuration file " + backup.manifest.site);
  const std::string name = std::string(kConfiguration) + config.filename().string();
  const bool is_taken =
      site->name != name && std::ranges::count(files, name, &ArchivedFile::name) > 0;
  if (is_taken) return fail("has a file " + name + " besides its configuration file");
  site->name = name;
  std::rotate(files.begin(), site, site + 1);
  return files;
}

/// The texts of the files where they are going to be.
files::FileTexts texts_of(const SitePlaces& places, const Archive& archive) {
  files::FileTexts texts;
  for (const ArchivedFile& file : archive) texts[places.at(file.name)] = file.bytes;
  return texts;
}

/// Sets the device of a camera in the text of the configuration file.
Result<> set_address(const files::Configuration& site, const CameraAddress& wanted,
                     std::string& text) {
  const auto camera = std::ranges::find(site.cameras, wanted.camera, &files::CameraSettings::name);
  if (camera == site.cameras.end()) return fail("there is no camera " + wanted.camera);
  const std::string_view key = files::facts_of(camera->back_end).address_key;
  if (key.empty()) return fail("camera " + wanted.camera + " has no device");
  return files::with_camera_address(text, wanted.camera, name_in_file(camera->back_end), key,
                                    wanted.address)
      .map([&text](std::string changed) { text = std::move(changed); });
}

void note_address(const std::string& table, const std::string& address,
                  std::vector<std::string>& notes) {
  if (hal::is_unspecified(address) || hal::is_loopback(address)) return;
  notes.push_back(table + " address = " + address + ": must be an address of this device");
}

std::vector<RestoredCamera> cameras_of(const files::Configuration& site) {
  std::vector<RestoredCamera> cameras;
  for (const auto& camera : site.cameras) {
    const std::string_view key = files::facts_of(camera.back_end).address_key;
    if (key.empty()) continue;
    cameras.push_back({camera.name, name_in_file(camera.back_end) + "." + std::string(key),
                       files::address_of(camera.back_end)});
  }
  return cameras;
}

std::vector<std::string> device_notes(const files::Configuration& site, const Manifest& manifest) {
  std::vector<std::string> notes;
  const auto& web = std::get<WebSettings>(site.sinks);
  note_address("[web]", web.address, notes);
  note_address("[modbus]", std::get<ModbusSettings>(site.sinks).address, notes);
  for (const std::string& name : web.names) {
    notes.push_back("[web] names: " + name + ": must lead to this device");
  }
  if (manifest.host != hal::host_name()) {
    notes.push_back("host name: " + hal::host_name() + "; that of the backup is " + manifest.host);
  }
  return notes;
}

EventPlace event_place_of(const files::Configuration& site) {
  const auto& recorder = std::get<RecorderSettings>(site.sinks);
  return {recorder.folder.empty() ? fs::path() : full_path(recorder.folder),
          static_cast<std::uint64_t>(recorder.reserve_mib) << 20};
}

}  // namespace

Result<CameraAddress> camera_address(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size()) {
    return fail("\"" + text + "\" must be NAME=ADDRESS");
  }
  return CameraAddress{text.substr(0, equals), text.substr(equals + 1)};
}

Result<SitePlaces> present_places(const fs::path& config) {
  const fs::path file = full_path(config);
  const auto site = files::read_site(file);
  return state_folder(site ? site->state_folder : fs::path(), file).map([&](const fs::path& state) {
    return SitePlaces{file.parent_path(), full_path(state)};
  });
}

Result<Restoration> restoration_of(const Backup& backup, const fs::path& config,
                                   const std::vector<CameraAddress>& cameras) {
  const fs::path file = full_path(config);
  if (const auto right = check_events(backup.manifest.events); !right) {
    return tl::unexpected(right.error());
  }
  auto present = present_places(file);
  if (!present) return tl::unexpected(present.error());
  auto files = renamed_files(backup, file);
  if (!files) return tl::unexpected(files.error());
  auto site = files::resolve(file, texts_of(*present, *files));
  if (site && !cameras.empty()) {
    for (const CameraAddress& wanted : cameras) {
      auto set = set_address(site->site, wanted, files->front().bytes);
      if (!set) return tl::unexpected(set.error());
    }
    site = files::resolve(file, texts_of(*present, *files));
  }
  if (!site) return fail("its configuration is not valid here: " + site.error().message);
  const auto state = state_folder(site->site.state_folder, file);
  if (!state) return tl::unexpected(state.error());
  std::error_code none;
  if (!fs::exists(file, none)) present->state = full_path(*state);
  if (present->state != full_path(*state)) {
    return fail("its state_folder is " + state->string() + ", that of this device " +
                present->state.string() + "; set state_folder of " + file.string() +
                " to the former first");
  }
  Restoration restoration{std::move(*present),    std::move(*files),
                          cameras_of(site->site), device_notes(site->site, backup.manifest),
                          backup.manifest.events, event_place_of(site->site)};
  if (!restoration.events.empty() && restoration.event_place.recordings.empty()) {
    restoration.events.clear();
    restoration.device_notes.emplace_back(
        "the kept events are not restored: the configuration has no folder in [recorder]");
  }
  return restoration;
}

std::vector<FileChange> changes_of(const Restoration& restoration) {
  std::vector<FileChange> changes;
  for (const ArchivedFile& file : restoration.files) {
    const fs::path path = restoration.places.at(file.name);
    std::error_code none;
    const bool is_there = fs::exists(fs::symlink_status(path, none));
    const auto old = hal::read_regular_file(path, kMostBytes);
    const bool is_same = old && *old == file.bytes;
    changes.push_back({file.name, !is_there ? "new" : is_same ? "same" : "changed", path});
  }
  const auto missing = missing_events(restoration.events, restoration.event_place);
  for (const ManifestEvent& event : restoration.events) {
    const bool is_new = std::ranges::find(missing, event) != missing.end();
    const std::string name = "events/" + event.name;
    changes.push_back({name, is_new ? "new" : "same", restoration.event_place.recordings / name});
  }
  return changes;
}

std::string changes_text(const Restoration& restoration) {
  constexpr std::size_t kColumn = 9;
  std::string text;
  for (const FileChange& change : changes_of(restoration)) {
    text +=
        change.word + std::string(kColumn - change.word.size(), ' ') + change.path.string() + "\n";
  }
  return text;
}

}  // namespace orbwatch::app::cli::backup
