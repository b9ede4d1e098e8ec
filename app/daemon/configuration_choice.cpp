#include "app/daemon/configuration_choice.h"

#include <cstdlib>
#include <utility>

#include "app/daemon/build.h"
#include "app/files/site_file.h"
#include "app/log.h"
#include "app/state/state_folder.h"

namespace orbwatch::app {
namespace {

Result<Resolved> resolve_and_check(const std::filesystem::path& file, const FileTexts& instead) {
  return resolve(file, instead).and_then([](Resolved site) {
    return check_keys(site, Dates::Ignored).map([&] { return std::move(site); });
  });
}

/// Nullopt: none was requested for this file, or it is wrong, which is logged.
std::optional<Chosen> choose_trial(const std::filesystem::path& folder,
                                   const std::filesystem::path& file) {
  auto trial = take_trial(folder);
  if (trial && !*trial) return std::nullopt;
  Result<Resolved> site = fail("it is for another configuration file");
  if (!trial) {
    site = tl::unexpected(trial.error());
  } else if ((*trial)->site == file) {
    site = resolve_and_check(file, (*trial)->texts);
  }
  if (site) return Chosen{std::move(*site), {}, std::move(*trial)};
  end_trial(folder);
  log_line(LogLevel::Error, "does not try the new configuration: " + site.error().message);
  return std::nullopt;
}

/// Nullopt: nothing that was confirmed is left to be written. It runs as it was confirmed while it
/// cannot be.
std::optional<Chosen> choose_confirmed(const std::filesystem::path& folder,
                                       const std::filesystem::path& file) {
  const auto finished = finish_confirmed(folder);
  if (finished) {
    if (*finished) log_line(LogLevel::Warning, "wrote the rest of a confirmed configuration");
    return std::nullopt;
  }
  const std::string why = "a confirmed configuration is not written: " + finished.error().message;
  log_line(LogLevel::Error, why);
  const auto confirmed = confirmed_trial(folder);
  if (!confirmed || !*confirmed || (*confirmed)->site != file) return std::nullopt;
  auto site = resolve_and_check(file, (*confirmed)->texts);
  if (!site) return std::nullopt;
  return Chosen{std::move(*site), why, {}};
}

}  // namespace

std::optional<std::filesystem::path> service_folder() {
  if (std::getenv("STATE_DIRECTORY") == nullptr) return std::nullopt;
  return state_folder({});
}

Result<Chosen> choose(const std::filesystem::path& file) {
  const auto folder = service_folder();
  if (folder) {
    if (end_trial(*folder)) {
      log_line(LogLevel::Warning, "the new configuration was not confirmed: the files count again");
    }
    if (auto confirmed = choose_confirmed(*folder, file)) return std::move(*confirmed);
    if (auto trial = choose_trial(*folder, file)) return std::move(*trial);
  }
  auto site = resolve_and_check(file, {});
  if (site) return Chosen{std::move(*site), {}, {}};
  if (!folder) return tl::unexpected(site.error());
  auto last_good = resolve_last_good(*folder, file);
  if (!last_good) return fail(site.error().message + "; " + last_good.error().message);
  log_line(LogLevel::Error, site.error().message + "; the last good configuration runs");
  return Chosen{std::move(*last_good), site.error().message, {}};
}

Result<> check_restart(const std::filesystem::path& file) {
  return resolve(file).and_then(
      [](const Resolved& site) { return check_site(site, Dates::Ignored); });
}

void keep(const Chosen& chosen) {
  const auto folder = service_folder();
  if (!folder || !chosen.refusal.empty() || chosen.trial) return;
  if (const auto kept = keep_last_good(*folder, chosen.site); !kept) {
    log_line(LogLevel::Warning, "what runs is not kept: " + kept.error().message);
  }
}

}  // namespace orbwatch::app
