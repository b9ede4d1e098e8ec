#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/model/recipe_change.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Limits of how long a new configuration runs until it is confirmed, s.
inline constexpr int kShortestTrial = 10, kLongestTrial = 3600, kUsualTrial = 60;

/// The files of the configuration, for interfaces by which people change them. A text that is sent
/// becomes the file byte for byte, with its comments and its order. Thread-safe; waits for the disk
/// and for the checks of a whole configuration.
class ConfigurationFiles {
 public:
  /// By the name of their file: its path from the folder of the configuration file.
  using Texts = std::map<std::string, std::string>;

  /// A file as it was read, and who changed it last.
  struct Version {
    std::string checksum;  ///< eight hexadecimal digits
    std::string time;      ///< of that change, UTC as ISO 8601
    std::string account;   ///< of the operating system
  };
  /// Checksums of the files that new texts were made of, by the name of the file.
  using Basis = std::map<std::string, std::string>;

  /// New texts, and what they were made of.
  struct Edit {
    Texts texts;
    Basis based_on;  ///< files that it does not name are taken as they are at the trial
  };

  /// The files, besides what runs in place of them for a time.
  struct State {
    std::string site;              ///< name of the configuration file
    Texts files;                   ///< as they are on the disk
    Texts outside;                 ///< others, a word in place of private ones; not to be changed
    std::string refusal;           ///< why they do not run, but the last good ones; empty: they do
    std::optional<Texts> trial{};  ///< runs in place of them, or is about to; nullopt: none
    std::optional<double> seconds_left{};  ///< until it goes back; nullopt: it does not run yet
    std::map<std::string, Version> versions{};  ///< of `files`
  };

  /// What a change consists of.
  struct Change {
    std::vector<std::string> files;  ///< that differ
    std::string difference;          ///< their lines, as text_difference() has them
  };

  virtual ~ConfigurationFiles() = default;

  /// Error: a file cannot be read.
  virtual Result<State> read() const = 0;

  /// The text of the file of the recipe of that number with changes; nothing else is done. Errors:
  /// there is no such recipe, its file is not to be changed here, cannot be read or has no place
  /// for a change.
  virtual Result<Edit> with_changed_recipe(int number, const RecipeChange& change) const = 0;

  /// Checks the files with these texts in place of some of them. Errors: with file, line, key, what
  /// is wrong and what is allowed; a name is not inside the folder; no file names it.
  virtual Result<Change> check(const Texts& texts) const = 0;

  /// As check(), and has them run for so many seconds. confirm() refuses when a file is not what
  /// they are based on. Errors: also nothing differs, a trial waits or runs, the files cannot be
  /// written, and what has no service manager's folder cannot go back.
  virtual Result<Change> try_out(const Edit& edit, int seconds) = 0;

  /// Writes the files of the trial that runs. Returns their names. Error: none runs; somebody else
  /// changed one of them meanwhile; the disk.
  virtual Result<std::vector<std::string>> confirm() = 0;

  /// Goes back to the files. Error: no trial waits or runs.
  virtual Result<> revert() = 0;
};

}  // namespace orbwatch::app
