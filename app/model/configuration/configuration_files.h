// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/model/configuration/recipe_change.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Limits of the time for which a configuration runs on trial, s.
inline constexpr int kShortestTrial = 10, kLongestTrial = 3600, kUsualTrial = 60;

/// The files of the configuration, for interfaces by which users change them. A sent text becomes
/// the file byte for byte, with its comments and its order. Thread-safe; waits for the disk and for
/// the checks of a whole configuration.
class ConfigurationFiles {
 public:
  /// Texts by file name: the path relative to the folder of the configuration file.
  using Texts = std::map<std::string, std::string>;

  /// Version of a file as it was read, with its last change.
  struct Version {
    std::string checksum;  ///< eight hexadecimal digits
    std::string time;      ///< time of the last change, UTC as ISO 8601
    std::string account;   ///< account of the operating system that made it
  };
  /// Checksums of the files from which new texts were made, by file name.
  using Basis = std::map<std::string, std::string>;

  /// New texts, and the versions on which they are based.
  struct Edit {
    Texts texts;
    Basis based_on;       ///< files not named here are taken as they are at the trial
    std::string owner{};  ///< user who sends them
  };

  /// The files, and the trial that runs instead of them.
  struct State {
    std::string site;  ///< name of the configuration file
    Texts files;       ///< contents on the disk
    Texts outside;     ///< files outside the folder, read-only; private ones are replaced by a word
    std::string refusal;  ///< reason why the last good files run instead; empty: these files run
    std::optional<Texts> trial{};  ///< texts that run instead, or are about to; nullopt: no trial
    /// Until the trial is reverted; nullopt: it does not run yet.
    std::optional<double> seconds_left{};
    std::string owner{};  ///< user who started the trial; empty: it was started on the board
    std::map<std::string, Version> versions{};  ///< versions of `files`
  };

  /// Result of a comparison of new texts with the files.
  struct Change {
    std::vector<std::string> files;  ///< names of files that differ
    std::string difference;          ///< differing lines, in the format of text_difference()
  };

  virtual ~ConfigurationFiles() = default;

  /// Error: a file cannot be read.
  virtual Result<State> read() const = 0;

  /// Returns the text of the recipe's file with the changes applied, and writes nothing. Errors:
  /// unknown recipe number; its file is read-only here, cannot be read, or cannot hold a change.
  virtual Result<Edit> with_changed_recipe(int number, const RecipeChange& change) const = 0;

  /// Checks the files with these texts in place of some of them. Errors: an invalid text, with
  /// file, line, key, fault and allowed values; a name outside the folder; a file that no other
  /// file refers to.
  virtual Result<Change> check(const Texts& texts) const = 0;

  /// Checks the texts like check(), and runs them on trial for `seconds`. confirm() refuses if a
  /// file differs from the version on which they are based. Errors: those of check(); nothing
  /// differs; a trial waits or runs; the files cannot be written; there is no folder of a service
  /// manager, so that the trial could not be reverted.
  virtual Result<Change> try_out(const Edit& edit, int seconds) = 0;

  /// Writes the files of the trial that runs. Returns their names. Error: no trial runs; another
  /// user changed one of the files meanwhile; a file cannot be written.
  virtual Result<std::vector<std::string>> confirm() = 0;

  /// Reverts to the files. Error: no trial waits or runs.
  virtual Result<> revert() = 0;
};

}  // namespace orbwatch::app
