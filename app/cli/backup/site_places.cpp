// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/site_places.h"

#include <algorithm>
#include <array>

#include "app/cli/archive/archive.h"
#include "app/files/runtime/trial.h"

namespace orbwatch::app::cli::backup {

namespace {

constexpr std::array<std::string_view, 3> kSecret{"users.json", "password-is-set",
                                                  "certificate.pem"};
constexpr std::array<std::string_view, 16> kHistory{"logins.json",
                                                    "first-code",
                                                    "audit.jsonl",
                                                    "audit.1.jsonl",
                                                    "audit-commands.jsonl",
                                                    "audit-commands.1.jsonl",
                                                    "audit-refused.jsonl",
                                                    "audit-refused.1.jsonl",
                                                    "last-good.json",
                                                    "alarm-history.json",
                                                    "last-good-calibration.json",
                                                    files::kRequestedTrial,
                                                    files::kRunningTrial,
                                                    files::kConfirmedTrial,
                                                    "trial-report.json",
                                                    "figure-history"};

/// Names of files of the state folder as in a backup.
template <std::size_t Count>
std::vector<std::string> names_in_backup(const std::array<std::string_view, Count>& files) {
  std::vector<std::string> names;
  names.reserve(Count);
  for (const std::string_view file : files) names.push_back(std::string(kState).append(file));
  return names;
}

}  // namespace

StateUse use_of(std::string_view file) {
  const bool is_picture = file.starts_with("clean-") && file.ends_with(".png");
  if (file == "calibration.toml" || file.starts_with("drift-zero-") || is_picture) {
    return StateUse::Plain;
  }
  if (std::ranges::count(kSecret, file) > 0) return StateUse::Secret;
  return std::ranges::count(kHistory, file) > 0 ? StateUse::History : StateUse::None;
}

std::vector<std::string> history_names() { return names_in_backup(kHistory); }

std::vector<std::string> trial_names() {
  return names_in_backup(
      std::array{files::kRequestedTrial, files::kRunningTrial, files::kConfirmedTrial});
}

const std::filesystem::path& SitePlaces::folder_of(const std::string& name) const {
  return name.starts_with(kState) ? state : configuration;
}

std::filesystem::path SitePlaces::at(const std::string& name) const {
  return folder_of(name) / name.substr(name.find('/') + 1);
}

std::filesystem::path full_path(const std::filesystem::path& path) {
  return std::filesystem::absolute(path).lexically_normal();
}

Result<> check_place(const std::string& name) {
  if (auto named = check_archived_name(name); !named) return named;
  const std::string file = name.substr(name.find('/') + 1);
  if (name.starts_with(kConfiguration)) return {};
  const bool is_plain_name = file.find('/') == file.npos;
  if (name.starts_with(kState) && is_plain_name && use_of(file) != StateUse::None) return {};
  return fail(name + ": is not a file of a site");
}

Result<> check_backed_up(const std::string& name) {
  if (auto placed = check_place(name); !placed) return placed;
  const bool is_history =
      name.starts_with(kState) && use_of(name.substr(kState.size())) == StateUse::History;
  if (is_history) return fail(name + ": is not a file of a backup");
  return {};
}

}  // namespace orbwatch::app::cli::backup
