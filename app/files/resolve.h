#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/files/calibration_file.h"
#include "app/files/configuration.h"
#include "app/files/text_file.h"
#include "app/model/status_report.h"
#include "app/pipeline/measurement/recipe.h"
#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app {

/// All files of a site, read together and checked against each other: every reference has its
/// index.
struct Resolved {
  /// The configuration file, with the state folder that follows from it and the environment; an
  /// empty one is another configuration's, and no alignments count.
  Configuration site;
  optics::Rig rig;  ///< with the alignments that are in force
  std::vector<CalibrationEntry> alignments;
  std::vector<std::size_t> rig_cameras;  ///< by camera: its place in the rig
  std::vector<Recipe> recipes;           ///< by place in site.recipes
  /// Views: those of the configuration, then those of the recipes, where one name is one view.
  StatusNames names;
  std::uint32_t checksum = 0;      ///< CRC-32 of all the files
  std::uint32_t rig_checksum = 0;  ///< of rig and lenses as they were read, see rig_checksum()
  FileTexts texts;                 ///< of all hand-written files
  FileTexts calibration;  ///< of the one file of accepted alignments; empty text: no such file

  const optics::RigCamera& rig_camera(std::size_t camera) const {
    return rig.cameras[rig_cameras[camera]];
  }
};

/// The configuration file by itself, as it stands. Errors as resolve().
Result<Configuration> read_site(const std::filesystem::path& file);

/// Reads a configuration file and all files that it names. Relative paths count from the folder of
/// the file that states them. The error says file, line, key, what is wrong and what is allowed.
/// `instead`: texts that count in place of files.
Result<Resolved> resolve(const std::filesystem::path& file, const FileTexts& instead = {});

/// The same for text that stands in for a file named `name`, with paths relative to `folder`.
Result<Resolved> resolve_text(const std::string& text, const std::string& name,
                              const std::filesystem::path& folder);

/// Sets every index and the names after a change of the settings. `name`: of the configuration
/// file, for the error, which is as of resolve().
Result<> resolve_references(Resolved& resolved, const std::string& name);

}  // namespace orbwatch::app
