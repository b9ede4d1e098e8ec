// SPDX-License-Identifier: Apache-2.0
#include "app/cli/archive/tar.h"

#include <algorithm>
#include <set>
#include <utility>

#include "app/cli/archive/tar_header.h"

namespace orbwatch::app::cli {
namespace {

bool is_zero(std::string_view bytes) { return bytes.find_first_not_of('\0') == bytes.npos; }

}  // namespace

Result<std::string> tar_of(const Archive& archive, std::chrono::sys_seconds made) {
  std::string bytes;
  for (const ArchivedFile& file : archive) {
    const auto header = tar_header({file.name, file.bytes.size(), file.mode}, made);
    if (!header) return tl::unexpected(header.error());
    bytes += *header;
    bytes += file.bytes;
    bytes.resize(tar_padded(bytes.size()), '\0');
  }
  bytes.append(2 * kTarBlock, '\0');  // the end
  return bytes;
}

Result<Archive> parse_tar(std::string_view bytes) {
  Archive archive;
  std::set<std::string> names;
  while (bytes.size() >= kTarBlock && !is_zero(bytes.substr(0, kTarBlock))) {
    auto entry = parse_tar_header(bytes.substr(0, kTarBlock));
    if (!entry) return tl::unexpected(entry.error());
    bytes.remove_prefix(kTarBlock);
    const std::string& name = entry->name;
    if (entry->size > bytes.size()) return fail(name + ": is cut off");
    if (!names.insert(name).second) return fail(name + ": occurs twice");
    if (names.size() > kMostArchivedFiles) {
      return fail("has more than " + std::to_string(kMostArchivedFiles) + " files");
    }
    std::string content(bytes.substr(0, entry->size));
    bytes.remove_prefix(std::min<std::uint64_t>(tar_padded(entry->size), bytes.size()));
    archive.push_back({std::move(entry->name), std::move(content), entry->mode});
  }
  if (bytes.size() < kTarBlock) return fail("is cut off");
  if (!is_zero(bytes)) return fail("has bytes after its end");
  return archive;
}

}  // namespace orbwatch::app::cli
