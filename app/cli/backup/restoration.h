// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/archive/archive.h"
#include "app/cli/backup/backup_file.h"
#include "app/cli/backup/events/restored_events.h"
#include "app/cli/backup/site_places.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli::backup {

/// Another device for a camera of a restored site.
struct CameraAddress {
  std::string camera;
  std::string address;
};

/// NAME=ADDRESS. Error: another form. Reentrant.
Result<CameraAddress> camera_address(const std::string& text);

/// Camera of a restored site that is one device.
struct RestoredCamera {
  std::string name;
  std::string key;  ///< key of the configuration, such as genicam.camera
  std::string address;
};

/// A backup that was checked for this appliance.
struct Restoration {
  SitePlaces places;
  Archive files;  ///< the configuration file first
  std::vector<RestoredCamera> cameras;
  std::vector<std::string> device_notes;  ///< lines about other settings of one device
  std::vector<ManifestEvent> events;      ///< none if the configuration has no recordings
  EventPlace event_place;
};

/// The places of the site `config` at present: without a readable configuration its state is in the
/// usual folder. Error: as state_folder().
Result<SitePlaces> present_places(const std::filesystem::path& config);

/// Checks a backup for the configuration file `config`, which may not exist yet, and sets the
/// cameras' devices. Errors: the configuration of the backup is not valid here; a camera without an
/// address; another state folder than at present; as check_events().
Result<Restoration> restoration_of(const Backup& backup, const std::filesystem::path& config,
                                   const std::vector<CameraAddress>& cameras);

/// A file or an event of a restoration compared with the present one.
struct FileChange {
  std::string name;
  std::string word;  ///< new, changed or same
  std::filesystem::path path;
};
std::vector<FileChange> changes_of(const Restoration& restoration);

/// Lines "new", "changed" or "same" with the file.
std::string changes_text(const Restoration& restoration);

}  // namespace orbwatch::app::cli::backup
