// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/daemon/configuration/configuration_choice.h"
#include "app/files/resolve.h"
#include "app/model/configuration/configuration_files.h"
#include "hal/clock.h"

namespace orbwatch::app::daemon {

/// The files that this daemon was started with.
class InstalledConfiguration final : public ConfigurationFiles {
 public:
  /// `chosen` runs in place of `file` or as it.
  InstalledConfiguration(std::filesystem::path file, const Chosen& chosen);

  /// The trial that runs goes back then.
  void set_trial_end(hal::TimePoint end) { trial_end_ = end; }

  Result<State> read() const override;
  Result<Edit> with_changed_recipe(int number, const RecipeChange& change) const override;
  Result<Change> check(const Texts& texts) const override;
  Result<Change> try_out(const Edit& edit, int seconds) override;
  Result<std::vector<std::string>> confirm() override;
  Result<> revert() override;

 private:
  /// Files that run, and those that the configuration on the disk names.
  std::set<std::filesystem::path> named_files() const;
  std::vector<std::filesystem::path> state_folders() const;
  Result<Edit> with_copied_recipe(const std::filesystem::path& recipe, const RecipeCopy& copy,
                                  Edit changed) const;
  Result<files::FileTexts> placed(const Texts& texts) const;
  Result<files::FileChecksums> checksums_in(const Basis& based_on) const;
  Result<std::filesystem::path> trial_folder() const;
  Change change_of(const files::Trial& trial) const;
  std::string name_of(const std::filesystem::path& file) const;

  const std::filesystem::path file_;
  const std::optional<std::filesystem::path> folder_ = service_folder();
  const std::string refusal_;
  const std::vector<std::filesystem::path> files_;  ///< of what runs
  std::atomic<hal::TimePoint> trial_end_{hal::TimePoint{}};
};

}  // namespace orbwatch::app::daemon
