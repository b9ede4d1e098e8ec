// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "app/cli/support/collection.h"
#include "app/cli/support/known_secrets.h"
#include "app/files/configuration.h"
#include "app/files/text/text_file.h"

namespace orbwatch::app::cli::support {

/// Places of the files of a site.
struct SiteFolders {
  std::filesystem::path configuration;
  std::optional<std::filesystem::path> state;  ///< nullopt: it belongs to another configuration
  std::vector<std::filesystem::path> keys;     ///< named files and folders that have keys
  std::filesystem::path profile;               ///< network profile of DDS; empty: none
};

/// `site`: null if the file cannot be read. `lib` has the state folders.
SiteFolders site_folders(const std::filesystem::path& config, const files::Configuration* site,
                         const std::filesystem::path& lib);

/// The secrets of the site, of this process and of the running orbwatchd. `proc` is the mount point
/// of procfs.
KnownSecrets secrets_of(const SiteFolders& folders, const std::filesystem::path& proc,
                        std::string_view environment);

/// Adds the configuration without comments: the `texts` that were read, and the other files of its
/// folder that are not keys by their name. Of these links are left out.
void add_configuration(const SiteFolders& folders, const files::FileTexts& texts, Collection& to);

/// Adds accepted alignments and events of alarms, and a list of all files of the state.
void add_state(const SiteFolders& folders, Collection& to);

/// Adds the newest pictures of the folder; empty: there is none.
void add_snapshots(const std::filesystem::path& folder, Collection& to);

}  // namespace orbwatch::app::cli::support
