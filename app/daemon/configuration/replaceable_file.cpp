// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/configuration/replaceable_file.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

namespace orbwatch::app::daemon {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kEndings = {".toml", ".yaml", ".yml"};

/// Links are followed as far as there are files. What cannot be followed may be anywhere.
bool is_below(const fs::path& file, const fs::path& folder) {
  std::error_code wrong_file, wrong_folder;
  const fs::path there = fs::weakly_canonical(fs::absolute(file, wrong_file), wrong_file);
  const fs::path above = fs::weakly_canonical(fs::absolute(folder, wrong_folder), wrong_folder);
  if (wrong_file || wrong_folder) return true;
  return std::ranges::mismatch(above, there).in1 == above.end();
}

bool is_private(const fs::file_status& status) {
  constexpr fs::perms kOthers = fs::perms::group_all | fs::perms::others_all;
  return fs::exists(status) && (status.permissions() & kOthers) == fs::perms::none;
}

Result<> check_present(const fs::path& file, const fs::file_status& status, bool is_named) {
  if (!is_named) {
    return fail(file.string() +
                ": exists, and the configuration does not name it; send a file that it names, or a "
                "new one");
  }
  if (is_private(status)) {
    return fail(file.string() +
                ": only its owner may read it, as a secret; a file of the configuration has mode "
                "0640 or 0644");
  }
  return {};
}

Result<> check_new(const fs::path& file) {
  if (is_configuration_name(file)) return {};
  return fail(file.string() +
              ": a new file of the configuration must end with .toml, .yaml or .yml");
}

}  // namespace

bool is_configuration_name(const fs::path& file) {
  return std::ranges::count(kEndings, file.extension().string()) > 0;
}

bool is_private(const fs::path& file) {
  std::error_code none;  // what cannot be looked at is not read either
  return is_private(fs::status(file, none));
}

Result<> check_replaceable(const fs::path& file, const fs::path& site,
                           const std::set<fs::path>& named, const std::vector<fs::path>& state) {
  for (const fs::path& folder : state) {
    // A folder that also holds the configuration says nothing about its files.
    if (is_below(file, folder) && !is_below(site, folder)) {
      return fail(file.string() +
                  ": is in the folder of the appliance's state, which is not a place for a "
                  "configuration");
    }
  }
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::exists(status)) return check_present(file, status, named.contains(file));
  if (status.type() != fs::file_type::not_found) {
    return fail(file.string() + ": cannot be looked at: " + error.message());
  }
  return check_new(file);
}

}  // namespace orbwatch::app::daemon
