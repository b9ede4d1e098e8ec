// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "app/cli/archive/tar.h"
#include "app/cli/backup/backup_file.h"
#include "app/cli/backup/site_places.h"
#include "tests/fuzz/stop.h"

/// Any bytes as a backup: it is refused in one sentence, or all its files have a place in a site.
/// An input is tried as it is, as the tar inside and as the manifest in that, since chance would
/// hardly find the checksums around them.
namespace orbwatch::fuzz {
namespace {

using namespace app::cli::backup;

void check(const Result<ReadBackup>& read) {
  if (!read) {
    require(!read.error().message.empty(), "no reason");
    require(read.error().message.find('\n') == std::string::npos, "more than one line");
    return;
  }
  const Backup& backup = read->backup;
  require(backup.files.size() == backup.manifest.files.size(), "a file is not in the manifest");
  for (const auto& file : backup.files) {
    require(check_backed_up(file.name).has_value(), "a file outside of a site");
    require(file.mode <= 07777U, "a mode with a type");
  }
}

}  // namespace
}  // namespace orbwatch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  std::string_view rest = bytes;
  orbwatch::app::cli::FrameReader frames([&rest](std::span<char> part) {
    const std::size_t count = std::min(part.size(), rest.size());
    std::copy_n(rest.begin(), count, part.begin());
    rest.remove_prefix(count);
    return orbwatch::Result<std::size_t>(count);
  });
  orbwatch::fuzz::check(orbwatch::app::cli::backup::read_backup(frames));
  orbwatch::fuzz::check(orbwatch::app::cli::backup::parse_backup_tar(bytes));
  const auto tar = orbwatch::app::cli::tar_of({{"manifest.json", std::string(bytes)}}, {});
  orbwatch::fuzz::require(tar.has_value(), "no tar");
  orbwatch::fuzz::check(orbwatch::app::cli::backup::parse_backup_tar(*tar));
  return 0;
}
