#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/files/text_file.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// CRC-32 of files, as FileVersion has it, by their path.
using FileChecksums = std::map<std::filesystem::path, std::uint32_t>;

/// A configuration that runs until it is confirmed, or for `seconds`. Until then the files stay as
/// they are: whatever ends the process, the next one runs them. In the folder of what must outlast
/// a restart:
///
///     request_trial() --> trial.json --take_trial()--> trial-running.json --end_trial()--> nothing
///                                           confirm_trial() --> trial-confirmed.json --> its files
///
/// These files are for their owner alone: they repeat texts that others may not be meant to read.
struct Trial {
  std::filesystem::path site;  ///< the configuration file that it is in place of
  FileTexts texts;             ///< by the path of the file that each will be
  int seconds = 0;
  /// The files when the texts were made of them: a change since then would be lost by the
  /// confirmation. Files that are not named may change.
  FileChecksums based_on{};
};

/// The checksums of these files as they are now.
FileChecksums checksums_of(const FileTexts& texts);

/// Asks the daemon that has this folder for a trial, and forgets what became of one before. Atomic.
/// Errors: a text is not UTF-8; as hal::write_file().
Result<> request_trial(const std::filesystem::path& folder, const Trial& trial);

/// Whether one was requested and not taken yet.
bool is_trial_requested(const std::filesystem::path& folder);
/// That one; nullopt: none. Error: it is damaged.
Result<std::optional<Trial>> requested_trial(const std::filesystem::path& folder);

/// Forgets the requested one, if any.
void drop_request(const std::filesystem::path& folder);

/// The requested one; it runs from now on, and is requested no more, so that it is run once.
/// A power cut after the return does not bring the request back. Nullopt: none. Errors:
/// it is damaged; the folder cannot be written, and it must not run.
Result<std::optional<Trial>> take_trial(const std::filesystem::path& folder);

/// The one that runs; nullopt: none, it was confirmed or ended. Error: it is damaged.
Result<std::optional<Trial>> running_trial(const std::filesystem::path& folder);

/// Tells who asked for a trial why it does not run; empty: it does. Error: as hal::write_file().
Result<> report_trial(const std::filesystem::path& folder, const std::string& refusal);
/// Report on the last request; nullopt: it is not known yet. Error: it is damaged.
Result<std::optional<std::string>> trial_report(const std::filesystem::path& folder);

/// None runs any more. Returns whether one did.
bool end_trial(const std::filesystem::path& folder);

/// Takes back the one that is requested or runs: the files count again. Error: there is none.
Result<> cancel_trial(const std::filesystem::path& folder);

/// Keeps the trial that runs: writes those of its texts that differ from their files, the
/// configuration file last. From its first moment on the confirmation counts: after a power cut
/// finish_confirmed() does what is left. Returns the files written. Errors: none runs; a file was
/// changed meanwhile by somebody else, who and when, and nothing is written; as hal::write_file(),
/// and it may be repeated.
Result<std::vector<std::filesystem::path>> confirm_trial(const std::filesystem::path& folder);

/// The one that was confirmed and is not written to the end; nullopt: none. Error: it is damaged.
Result<std::optional<Trial>> confirmed_trial(const std::filesystem::path& folder);

/// Writes what confirm_trial() has not. Returns the files written; nullopt: there was nothing to
/// finish. Errors: it is damaged; as hal::write_file(), and it may be repeated.
Result<std::optional<std::vector<std::filesystem::path>>> finish_confirmed(
    const std::filesystem::path& folder);

}  // namespace orbwatch::app
