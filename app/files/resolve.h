// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/files/configuration.h"
#include "app/files/runtime/calibration_file.h"
#include "app/files/text/text_file.h"
#include "app/model/status/status_report.h"
#include "app/pipeline/measurement/recipe.h"
#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app::files {

/// All files of a site, read together and checked against each other: every reference has its
/// index.
struct Resolved {
  Configuration site;          ///< the configuration file
  std::filesystem::path file;  ///< its path
  /// Folder of state that survives a restart, from the configuration file and the environment, see
  /// state_folder(). Empty: it belongs to another configuration, and alignments are not applied.
  std::filesystem::path state_folder;
  optics::Rig rig;  ///< rig with the alignments in force
  std::vector<CalibrationEntry> alignments;
  std::vector<std::size_t> rig_cameras;   ///< index in the rig for each camera
  std::vector<pipeline::Recipe> recipes;  ///< recipes in the order of site.recipes
  /// Views: those of the configuration, then those of the recipes, where equal names mean one view.
  StatusNames names;
  std::uint32_t checksum = 0;      ///< CRC-32 of all the files
  std::uint32_t rig_checksum = 0;  ///< checksum of rig and lenses as read, see rig_checksum()
  FileTexts texts;                 ///< texts of all hand-written files
  FileTexts calibration;  ///< text of the file of accepted alignments; empty text: no such file

  const optics::RigCamera& rig_camera(std::size_t camera) const {
    return rig.cameras[rig_cameras[camera]];
  }
};

/// Reads only the configuration file, unresolved. Arguments and errors: as resolve().
Result<Configuration> read_site(const std::filesystem::path& file, const FileTexts& instead = {});

/// Reads a configuration file and all files that it names. Relative paths are based on the folder
/// of the file that states them. The error states file, line, key, reason and the allowed values.
/// `instead`: texts that replace files. `state_folder`: in place of that of the configuration.
Result<Resolved> resolve(const std::filesystem::path& file, const FileTexts& instead = {},
                         const std::optional<std::filesystem::path>& state_folder = {});

/// Resolves text in place of a file named `name`, with paths relative to `folder`.
Result<Resolved> resolve_text(const std::string& text, const std::string& name,
                              const std::filesystem::path& folder);

/// Sets every index and the names after a change of the settings. `name` is the configuration
/// file's, for the error. Errors: as resolve().
Result<> resolve_references(Resolved& resolved, const std::string& name);

}  // namespace orbwatch::app::files
