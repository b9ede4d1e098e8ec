// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/configuration/configuration_choice.h"

#include <string>
#include <utility>

#include "app/daemon/site/site_check.h"
#include "app/daemon/site/view_memory.h"
#include "app/files/runtime/site_file.h"
#include "app/log.h"
#include "app/state/state_folder.h"

namespace orbwatch::app::daemon {
namespace {

Result<files::Resolved> resolve_and_check(const std::filesystem::path& file,
                                          const files::FileTexts& instead) {
  return files::resolve(file, instead).and_then([](files::Resolved site) {
    return check_view_memory(site)
        .and_then([&] { return check_keys(site, Dates::Ignored); })
        .map([&] { return std::move(site); });
  });
}

/// The one file of alignments as it will be with another entry.
Result<files::FileTexts> with_accepted(files::FileTexts calibration, CalibrationEntry entry) {
  auto& [file, text] = *calibration.begin();
  files::TextFiles files(calibration);
  auto entries = load_calibrations(file, files);
  if (!entries) return tl::unexpected(entries.error());
  files::accept(*entries, std::move(entry));
  text = files::calibrations_text(*entries);
  return calibration;
}

/// Tells who asked for a trial.
void report(const std::filesystem::path& folder, const std::string& refusal) {
  if (const auto told = files::report_trial(folder, refusal); !told) {
    log_line(LogLevel::Warning,
             "the report on the new configuration is not written: " + told.error().message);
  }
}

/// Nullopt: none was requested for this file, or it is wrong, which is logged.
std::optional<Chosen> choose_trial(const std::filesystem::path& folder,
                                   const std::filesystem::path& file) {
  auto trial = files::take_trial(folder);
  if (trial && !*trial) return std::nullopt;
  Result<files::Resolved> site = fail("it is for another configuration file");
  if (!trial) {
    site = tl::unexpected(trial.error());
  } else if ((*trial)->site == file) {
    site = resolve_and_check(file, (*trial)->texts);
  }
  if (site) return Chosen{std::move(*site), {}, std::move(*trial)};
  report(folder, site.error().message);
  files::end_trial(folder);
  log_line(LogLevel::Error, "does not try the new configuration: " + site.error().message);
  return std::nullopt;
}

/// Nullopt: nothing that was confirmed is left to be written. It runs as it was confirmed while it
/// cannot be.
std::optional<Chosen> choose_confirmed(const std::filesystem::path& folder,
                                       const std::filesystem::path& file) {
  const auto finished = files::finish_confirmed(folder);
  if (finished) {
    if (*finished) log_line(LogLevel::Warning, "wrote the rest of a confirmed configuration");
    return std::nullopt;
  }
  const std::string why = "a confirmed configuration is not written: " + finished.error().message;
  log_line(LogLevel::Error, why);
  const auto confirmed = files::confirmed_trial(folder);
  if (!confirmed || !*confirmed || (*confirmed)->site != file) return std::nullopt;
  auto site = resolve_and_check(file, (*confirmed)->texts);
  if (!site) return std::nullopt;
  return Chosen{std::move(*site), why, {}};
}

/// Whatever ran with this folder before, it is this configuration file's now: so the unit says.
void take_over(const std::filesystem::path& folder, const std::filesystem::path& file) {
  const auto before = record_owner(folder, file);
  if (!before) {
    log_line(LogLevel::Warning,
             "does not record whose state folder it is: " + before.error().message);
  } else if (*before) {
    log_line(LogLevel::Warning, folder.string() + ": was the state folder of " +
                                    (*before)->string() + ", is that of " + file.string() + " now");
  }
}

/// A trial, the files, or what ran last.
Result<Chosen> choose_texts(const std::optional<std::filesystem::path>& folder,
                            const std::filesystem::path& file) {
  if (folder) {
    if (files::end_trial(*folder)) {
      log_line(LogLevel::Warning, "the new configuration was not confirmed: the files count again");
    }
    if (auto confirmed = choose_confirmed(*folder, file)) return std::move(*confirmed);
    if (auto trial = choose_trial(*folder, file)) return std::move(*trial);
  }
  auto site = resolve_and_check(file, {});
  if (site) return Chosen{std::move(*site), {}, {}};
  if (!folder) return tl::unexpected(site.error());
  auto last_good = files::resolve_last_good(*folder, file);
  if (!last_good) return fail(site.error().message + "; " + last_good.error().message);
  log_line(LogLevel::Error, site.error().message + "; the last good configuration runs");
  return Chosen{std::move(*last_good), site.error().message, {}};
}

}  // namespace

std::optional<std::filesystem::path> service_folder() { return state_directory(); }

Result<Chosen> choose(const std::filesystem::path& file) {
  const auto folder = service_folder();
  if (folder) take_over(*folder, file);
  auto chosen = choose_texts(folder, file);
  if (!chosen || !chosen->site.state_folder.empty()) return chosen;
  auto settled = folder ? Result<std::filesystem::path>(*folder) : state_folder({}, file);
  if (!settled) return tl::unexpected(settled.error());
  chosen->site.state_folder = std::move(*settled);
  return chosen;
}

bool is_trial_for(const std::filesystem::path& folder, const std::filesystem::path& file) {
  if (!files::is_trial_requested(folder)) return false;
  const auto trial = files::requested_trial(folder);
  if (trial && !*trial) return false;
  if (trial && (*trial)->site == file) return true;
  const std::string why = trial
                              ? "it is for " + (*trial)->site.string() + ", this orbwatchd runs " +
                                    file.string() + "; say --config to orbwatch configure"
                              : trial.error().message;
  report(folder, why);
  log_line(LogLevel::Error, "does not try the new configuration: " + why);
  files::drop_request(folder);
  return false;
}

Result<> check_restart(const std::filesystem::path& file) {
  return files::resolve(file).and_then(
      [](const files::Resolved& site) { return check_site(site, Dates::Ignored); });
}

Result<> check_acceptance(const std::filesystem::path& file, const files::Resolved& running,
                          CalibrationEntry entry) {
  if (const auto folder = service_folder()) {
    const auto trial = files::running_trial(*folder);
    if (!trial) return tl::unexpected(trial.error());
    if (*trial) {
      return fail(
          "a new configuration is on trial, and the restart would end it; confirm or revert it "
          "first");
    }
  }
  // A damaged file of alignments is written anew when one is accepted.
  const auto next = files::resolve(file, running.calibration);
  if (!next) {
    return fail("orbwatchd cannot restart with its files; correct them first: " +
                next.error().message);
  }
  if (next->rig_checksum != running.rig_checksum) {
    return fail(
        next->site.rig.path.string() +
        ": the rig was changed since the start, and the alignment is for the one that runs; "
        "restart first, then align again");
  }
  entry.rig = running.rig_checksum;
  return with_accepted(running.calibration, std::move(entry))
      .and_then([&](const files::FileTexts& accepted) { return files::resolve(file, accepted); })
      .and_then([](const files::Resolved& site) { return check_site(site, Dates::Ignored); })
      .map_error(
          [](const Error& error) { return Error{"a restart would be refused: " + error.message}; });
}

void warn_of_refusal(const Chosen& chosen) {
  if (!chosen.refusal.empty() || chosen.trial) return;
  const auto checked = check_site(chosen.site, Dates::Ignored);
  if (checked) return;
  log_line(LogLevel::Warning,
           checked.error().message + "; correct it: no restart or alignment is accepted before");
}

void keep(const Chosen& chosen) {
  const auto folder = service_folder();
  if (!folder || !chosen.refusal.empty()) return;
  if (chosen.trial) return report(*folder, {});
  if (const auto kept = keep_last_good(*folder, chosen.site); !kept) {
    log_line(LogLevel::Warning, "what runs is not kept: " + kept.error().message);
  }
}

}  // namespace orbwatch::app::daemon
