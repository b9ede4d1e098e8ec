// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/files/text/text_file.h"
#include "app/model/alignment/accepted_alignments.h"
#include "proc/image/result.h"

namespace orbwatch::app::files {

/// Number of entries that are kept; older ones are dropped.
inline constexpr std::size_t kMaxCalibrations = 100;

/// File in the folder of state that survives a restart.
std::filesystem::path calibration_file(const std::filesystem::path& state_folder);

/// Checksum that reveals a change of a rig file or of a lens that it names. `instead`: see
/// TextFiles. Error: as load_rig().
Result<std::uint32_t> rig_checksum(const std::filesystem::path& rig, const FileTexts& instead = {});

/// Reads the entries, oldest first; none without such a file. Error: file, line, key and the
/// allowed values.
Result<std::vector<CalibrationEntry>> load_calibrations(const std::filesystem::path& file,
                                                        TextFiles& files);

/// Text from which load_calibrations() reads the newest kMaxCalibrations of them.
std::string calibrations_text(const std::vector<CalibrationEntry>& entries);

/// Writes that text. Error: as hal::write_file().
Result<> save_calibrations(const std::filesystem::path& file,
                           const std::vector<CalibrationEntry>& entries);

/// Keeps a damaged file beside the original, so that nothing is lost when it is written anew: by a
/// hard link, as a copy, or, if neither is possible, by renaming it. Returns the kept name. Error:
/// the reason why none could be made.
Result<std::filesystem::path> keep_damaged(const std::filesystem::path& file);

/// Entries in force for that rig: the newest one of each camera, oldest first.
std::vector<CalibrationEntry> in_force(const std::vector<CalibrationEntry>& entries,
                                       std::uint32_t rig);

/// Appends an entry with the next number and the present time.
void accept(std::vector<CalibrationEntry>& entries, CalibrationEntry entry);

}  // namespace orbwatch::app::files
