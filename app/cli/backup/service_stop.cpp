// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/service_stop.h"

#include <system_error>

#include "app/cli/backup/placement.h"
#include "app/cli/backup/restoration.h"
#include "app/state/state_folder.h"

namespace orbwatch::app::cli::backup {

Result<hal::FileDescriptor> exclude_daemon(const std::filesystem::path& config,
                                           const SitePlaces& places) {
  auto reserved = reserve(places.state);
  if (reserved) return reserved;
  return fail("orbwatchd runs; stop it first: systemctl stop " + unit_of(config));
}

Result<std::string> undo_interrupted(const std::filesystem::path& config) {
  const auto places = present_places(config);
  if (!places) return tl::unexpected(places.error());
  std::error_code none;
  if (!std::filesystem::exists(undo_file(*places), none)) return std::string();
  const auto reserved = exclude_daemon(config, *places);
  if (!reserved) return tl::unexpected(reserved.error());
  DiskChanges disk;
  return undo_unfinished(*places, disk).map([](bool) {
    return std::string("an interrupted restore was undone: the old files are back\n");
  });
}

}  // namespace orbwatch::app::cli::backup
