// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/files/resolve.h"
#include "app/files/runtime/trial.h"

namespace orbwatch::app::daemon {

/// A configuration and why it runs.
struct Chosen {
  files::Resolved site;
  std::string refusal;  ///< of the files, whose last good version this is; empty: of none
  std::optional<files::Trial> trial;  ///< this runs in place of the files until it is confirmed
};

/// Where a service keeps trials and the last good configuration; nullopt: this is no service, it
/// has no STATE_DIRECTORY. Not while the environment is changed.
std::optional<std::filesystem::path> service_folder();

/// True: a trial of the configuration `file` is requested in the service's folder. A request that
/// is damaged or for another configuration file is refused: logged and dropped.
bool is_trial_for(const std::filesystem::path& folder, const std::filesystem::path& file);

/// What runs: of a service, a confirmed trial that is not written yet; a requested trial, once;
/// else what the files say; if they are wrong, of a service, the last good configuration. A trial
/// that a run before left unconfirmed has ended. A service records in its folder that it is this
/// file's. Error: the files', and why there is no last good configuration; no service, and the
/// state folder is another configuration's.
Result<Chosen> choose(const std::filesystem::path& file);

/// Whether the files say what can run. Error: why not.
Result<> check_restart(const std::filesystem::path& file);

/// Checks that the alignment of `entry`, found with `running`, the site that runs in place of
/// `file` or as it, would be in force after a restart. Error: why not, and what to do first: a
/// trial runs, which the restart would end; the files are wrong; the rig that they state is another
/// one; check_restart() would refuse the site with it.
Result<> check_acceptance(const std::filesystem::path& file, const files::Resolved& running,
                          CalibrationEntry entry);

/// Warns if check_restart() would refuse the files that run: a start demands less, so that an
/// update does not stop a machine. Takes the time of check_site(); call it once the site runs.
void warn_of_refusal(const Chosen& chosen);

/// Notes a start: keeps the configuration as good, or tells who asked for a trial that it runs.
void keep(const Chosen& chosen);

}  // namespace orbwatch::app::daemon
