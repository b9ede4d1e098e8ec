// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/site_places.h"

#include "app/cli/archive/archive.h"

namespace orbwatch::app::cli::backup {

StateUse use_of(std::string_view file) {
  const bool is_picture = file.starts_with("clean-") && file.ends_with(".png");
  if (file == "calibration.toml" || file.starts_with("drift-zero-") || is_picture) {
    return StateUse::Plain;
  }
  const bool is_secret =
      file == "users.json" || file == "password-is-set" || file == "certificate.pem";
  return is_secret ? StateUse::Secret : StateUse::None;
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
  return fail(name + ": is not a file of a backup");
}

}  // namespace orbwatch::app::cli::backup
