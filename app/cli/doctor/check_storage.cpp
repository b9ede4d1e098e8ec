// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "app/cli/doctor/checks.h"

/// Checks of space for state that must survive a restart, and for pictures.
namespace orbwatch::app::cli::doctor {
namespace {

constexpr double kFull = 20;         // MiB; an accepted alignment may no longer be kept
constexpr double kNearlyFull = 500;  // MiB

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
