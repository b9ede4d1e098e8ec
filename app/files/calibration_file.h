#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/files/rig_alignment.h"
#include "app/files/text_file.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// An alignment that was accepted, and how it came about.
struct CalibrationEntry {
  int number = 0;    ///< counts entries from 1
  std::string time;  ///< UTC, as utc_text()
  std::string method;
  std::string quality;
  /// Of the rig file and its lenses that the alignment is for: it corrects no other. See
  /// rig_checksum().
  std::uint32_t rig = 0;
  RigAlignment alignment;  ///< of one camera; none: as the rig file has it
};

/// The one camera of an entry. Reentrant.
inline const CameraAlignment& camera_of(const CalibrationEntry& entry) {
  return entry.alignment.cameras.front();
}

/// How many entries are kept; older ones are dropped.
inline constexpr std::size_t kMaxCalibrations = 100;

/// Its place in the folder of what must outlast a restart.
std::filesystem::path calibration_file(const std::filesystem::path& state_folder);

/// What tells whether a rig file, or a lens that it names, was changed. `instead`: see TextFiles.
/// Error: as load_rig().
Result<std::uint32_t> rig_checksum(const std::filesystem::path& rig, const FileTexts& instead = {});

/// The entries, oldest first; none without such a file. Error: file, line, key and what is allowed.
Result<std::vector<CalibrationEntry>> load_calibrations(const std::filesystem::path& file,
                                                        TextFiles& files);

/// The text of which load_calibrations() makes the newest kMaxCalibrations of them.
std::string calibrations_text(const std::vector<CalibrationEntry>& entries);

/// Writes that text. Error: as hal::write_file().
Result<> save_calibrations(const std::filesystem::path& file,
                           const std::vector<CalibrationEntry>& entries);

/// Keeps a damaged file beside it, so that nothing is lost when it is written anew: by a second
/// name, as a copy, or, where neither is possible, under another name only. Returns that name.
/// Error: why it has none.
Result<std::filesystem::path> keep_damaged(const std::filesystem::path& file);

/// The entries in force for that rig: of each camera the newest one for it, oldest first.
std::vector<CalibrationEntry> in_force(const std::vector<CalibrationEntry>& entries,
                                       std::uint32_t rig);

/// Adds an entry behind the others, with the next number and the time of now.
void accept(std::vector<CalibrationEntry>& entries, CalibrationEntry entry);

}  // namespace orbwatch::app
