// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::app::cli::backup {

inline constexpr std::string_view kConfiguration = "configuration/";
inline constexpr std::string_view kState = "state/";

/// Use of a file of the state folder.
enum class StateUse {
  None,     ///< belongs to the device, such as the record of commands
  History,  ///< sessions, events, kept configurations: removed by a reset, not backed up
  Plain,    ///< alignments, and what they are compared with
  Secret    ///< users, and the key of the page's certificate
};

/// `file` is the name in the state folder.
StateUse use_of(std::string_view file);

/// Names, as in a backup, of the files of the state that a running daemon may write at its end.
std::vector<std::string> history_names();

/// Names, as in a backup, of the files of a configuration on trial. A restore removes them: a
/// confirmation that was not completed would overwrite the restored files at the next start.
std::vector<std::string> trial_names();

/// Folders of a site, and the names of their files here and in a backup.
struct SitePlaces {
  std::filesystem::path configuration;
  std::filesystem::path state;

  /// The file of a name that check_place() accepts.
  std::filesystem::path at(const std::string& name) const;
  /// The folder that has it.
  const std::filesystem::path& folder_of(const std::string& name) const;
};

/// The path as absolute, without "." and ".."; links are not followed.
std::filesystem::path full_path(const std::filesystem::path& path);

/// Error: not configuration/FILE or state/FILE, FILE with a use. Reentrant.
Result<> check_place(const std::string& name);

/// Error: also a file that is not backed up.
Result<> check_backed_up(const std::string& name);

}  // namespace orbwatch::app::cli::backup
