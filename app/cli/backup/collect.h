// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/backup/backup_file.h"
#include "app/cli/backup/site_places.h"
#include "app/files/configuration.h"
#include "app/files/text/text_file.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli::backup {

/// A site that is backed up.
struct Site {
  std::filesystem::path file;  ///< configuration file, absolute
  SitePlaces places;
  std::vector<std::filesystem::path> recordings;  ///< folders that are left out
  std::vector<std::filesystem::path> named;  ///< files and folders that the configuration names
};

/// The site of a configuration; `texts` are all that it names.
Site site_of(const std::filesystem::path& file, const std::filesystem::path& state,
             const files::Configuration& configuration, const files::FileTexts& texts);

/// Names of all files of the configuration's folder, sorted, without those of recordings, of state
/// and of a second machine. Error: the folder cannot be read, or has too many.
Result<std::vector<std::string>> configuration_names(const Site& site);

/// Names of the files of the state with a use, sorted. Error: the folder cannot be read.
Result<std::vector<std::string>> state_names(const Site& site);

/// Reads all files of the configuration's folder and those of the state that have a use. A file is
/// secret if it is accessible to its owner only, has a private key or is not of a kind that
/// configurations consist of. Links, large files and named files elsewhere are listed as left out.
/// Error: a file cannot be read.
Result<Backup> collect(const Site& site);

}  // namespace orbwatch::app::cli::backup
