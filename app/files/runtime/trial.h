// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/files/text/text_file.h"
#include "proc/image/result.h"

namespace orbwatch::app::files {

/// Names of the files of a trial in the folder of state; see Trial.
inline constexpr std::string_view kRequestedTrial = "trial.json";
inline constexpr std::string_view kRunningTrial = "trial-running.json";
inline constexpr std::string_view kConfirmedTrial = "trial-confirmed.json";

/// CRC-32 of files by their path; see FileVersion.
using FileChecksums = std::map<std::filesystem::path, std::uint32_t>;

/// Configuration that runs until it is confirmed, or for `seconds`. Until then the files are
/// unchanged: whenever the process ends, the next one runs them. Files in the folder of state that
/// survives a restart:
///
///     request_trial() --> trial.json --take_trial()--> trial-running.json --end_trial()--> nothing
///                                           confirm_trial() --> trial-confirmed.json --> its files
///
/// Only the owner can read these files: they repeat texts that may be confidential.
struct Trial {
  std::filesystem::path site;  ///< configuration file that the trial replaces
  FileTexts texts;             ///< texts by the path of their future file
  int seconds = 0;
  /// Checksums of the files that the texts were based on: the confirmation would lose a later
  /// change. Files that are not listed may change.
  FileChecksums based_on{};
  std::string owner{};  ///< user of the page who started it; empty: it was started on the board
};

/// Present checksums of these files.
FileChecksums checksums_of(const FileTexts& texts);

/// Requests a trial from the daemon that has this folder, and drops the report on a previous one.
/// Atomic. Errors: a text is not UTF-8; as hal::write_file().
Result<> request_trial(const std::filesystem::path& folder, const Trial& trial);

/// True if a trial was requested and not taken yet.
bool is_trial_requested(const std::filesystem::path& folder);
/// The requested trial; nullopt: none. Error: it is damaged.
Result<std::optional<Trial>> requested_trial(const std::filesystem::path& folder);

/// Drops the requested trial, if any.
void drop_request(const std::filesystem::path& folder);

/// Takes the requested trial; it runs from now on and is no longer requested, so that it is run
/// once. A power cut after the return does not restore the request. Nullopt: none. Errors: it is
/// damaged; the folder cannot be written, and it must not run.
Result<std::optional<Trial>> take_trial(const std::filesystem::path& folder);

/// The running trial; nullopt: none, it was confirmed or ended. Error: it is damaged.
Result<std::optional<Trial>> running_trial(const std::filesystem::path& folder);

/// Reports to the sender of the request why the trial does not run; empty: it runs. Error: as
/// hal::write_file().
Result<> report_trial(const std::filesystem::path& folder, const std::string& refusal);
/// Report on the last request; nullopt: it is not known yet. Error: it is damaged.
Result<std::optional<std::string>> trial_report(const std::filesystem::path& folder);

/// Ends the running trial. Returns false if there was none.
bool end_trial(const std::filesystem::path& folder);

/// Cancels the requested or running trial: the files apply again. Error: there is none.
Result<> cancel_trial(const std::filesystem::path& folder);

/// Confirms the running trial: writes those of its texts that differ from their files, the
/// configuration file last. The confirmation is in effect at once: after a power cut
/// finish_confirmed() completes it. Returns the files written. Errors: none runs; a file was
/// changed since, with account and time, and nothing is written; as hal::write_file(), and it may
/// be repeated.
Result<std::vector<std::filesystem::path>> confirm_trial(const std::filesystem::path& folder);

/// The trial that was confirmed but not written completely; nullopt: none. Error: it is damaged.
Result<std::optional<Trial>> confirmed_trial(const std::filesystem::path& folder);

/// Completes the writing of confirm_trial(). Returns the files written; nullopt: there was nothing
/// to finish. Errors: it is damaged; as hal::write_file(), and it may be repeated.
Result<std::optional<std::vector<std::filesystem::path>>> finish_confirmed(
    const std::filesystem::path& folder);

}  // namespace orbwatch::app::files
