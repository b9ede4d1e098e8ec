// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "app/cli/doctor/checks.h"
#include "app/files/lexical_path.h"

/// Checks of space for state that must survive a restart, and for pictures.
namespace orbwatch::app::cli::doctor {
namespace {

constexpr double kFull = 20;         // MiB; an accepted alignment may no longer be kept
constexpr double kNearlyFull = 500;  // MiB

/// Diagnosis of a folder that the service cannot write.
Diagnosis closed_folder(const std::string& who, const FolderFacts& folder) {
  const std::string path = folder.path.string();
  const std::string give = "sudo install -d -o orbwatch -g orbwatch " + path;
  if (folder.access == Access::Denied) {
    return fault(who + "not writable for the service's user", give);
  }
  const std::string text = who + "read-only for the service " + folder.unit;
  for (const char* home : {"/home", "/root"}) {
    if (files::is_lexically_below(folder.path, home)) {
      return fault(text, std::string("another folder: ProtectHome= of the unit hides ") + home);
    }
  }
  // The hyphen lets the service start without the disk.
  return fault(text, give + "; sudo systemctl edit " + folder.unit +
                         " with the lines [Service] and ReadWritePaths=-" + path +
                         "; sudo systemctl restart " + folder.unit);
}

Diagnosis folder_diagnosis(const FolderFacts& folder) {
  if (!folder.error.empty()) {
    return fault(folder.use + " folder: " + folder.error,
                 "sudo STATE_DIRECTORY=FOLDER orbwatch doctor --config FILE");
  }
  const std::string who = folder.use + " " + folder.path.string() + ": ";
  const std::string room = "df -h " + folder.path.string() + " shows it; remove what is not needed";
  if (folder.read_only) {
    return fault(
        who + "its file system is read only",
        "sudo mount -o remount,rw $(df --output=target " + folder.path.string() + " | tail -1)");
  }
  if (folder.access == Access::ReadOnly || folder.access == Access::Denied) {
    return closed_folder(who, folder);
  }
  if (!folder.free) return warning(who + "its free space cannot be read", "df -h");
  std::string text = who + std::to_string(std::lround(*folder.free)) + " MiB free";
  if (folder.free_share) text += ", " + std::to_string(std::lround(*folder.free_share)) + " %";
  if (*folder.free < kFull) return fault(text, room);
  if (*folder.free < kNearlyFull) return warning(text, room);
  return ok(text);
}

}  // namespace

Diagnoses check_disk(const Facts& facts) {
  Diagnoses found;
  for (const FolderFacts& folder : facts.folders) found.push_back(folder_diagnosis(folder));
  return found;
}

}  // namespace orbwatch::app::cli::doctor
