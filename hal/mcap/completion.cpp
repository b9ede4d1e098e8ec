// SPDX-License-Identifier: Apache-2.0
#include "hal/mcap/completion.h"

#include <algorithm>
#include <utility>

#include "hal/mcap/crc32.h"
#include "hal/mcap/file.h"
#include "hal/mcap/scan.h"
#include "hal/mcap/summary_reader.h"

namespace orbwatch::hal::mcap {
namespace {

/// Bytes that make the file whole from scanned.data_end on: what is missing of its begin or of the
/// last chunk's indexes, and the end.
Bytes missing_bytes(Scan& scanned) {
  Bytes bytes;
  if (!scanned.header) {
    bytes.assign(kMagic.begin(), kMagic.end());
    append_record(bytes, Header{});
  }
  if (scanned.lacks_indexes) {
    scanned.last_indexes.append_to(bytes, scanned.data_end, scanned.summary.chunks.back());
  }
  append_end(bytes, scanned.summary, scanned.data_end + bytes.size(),
             crc32_of(bytes, scanned.data_crc));
  return bytes;
}

}  // namespace

FileResult<Completion> complete(const std::filesystem::path& path, const Limits& limits) {
  auto file = File::open(path, File::Access::Change);
  if (!file) return error_of(file);
  auto section = find_summary(*file, limits);
  if (!section) return error_of(section);
  Completion completion;
  if (*section) {
    auto summary = read_summary(*file, **section, limits);
    if (!summary) return error_of(summary);
    completion.was_finished = true;
    completion.messages = summary->statistics().message_count;
    return completion;
  }
  const auto size = file->size();
  if (!size) return tl::unexpected(size.error());
  auto scanned = scan(*file, limits);
  if (!scanned) return error_of(scanned);
  completion.messages = scanned->summary.statistics().message_count;
  completion.damaged = scanned->damaged;
  completion.dropped_bytes = *size - std::min(*size, scanned->data_end);
  const Bytes end = missing_bytes(*scanned);
  if (auto done = file->replace_end(scanned->data_end, end); !done) return error_of(done);
  return completion;
}

}  // namespace orbwatch::hal::mcap
