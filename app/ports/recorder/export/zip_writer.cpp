// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/zip_writer.h"

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <limits>
#include <span>

#include "hal/calendar_time.h"
#include "hal/mcap/crc32.h"
#include "hal/mcap/file.h"

namespace orbwatch::app::recorder {
namespace {

using hal::mcap::Bytes;
using hal::mcap::FieldWriter;
using hal::mcap::kMebibyte;

constexpr std::uint64_t kMostOfZip = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kLocalHead = 0x04034b50, kListHead = 0x02014b50, kListEnd = 0x06054b50;
constexpr std::uint16_t kVersion = 20, kMadeOnUnix = 3 << 8 | kVersion, kNothing = 0;
constexpr std::uint16_t kUtf8Names = 0x0800, kStored = 0;
constexpr std::uint32_t kRegularFile = 0100640U << 16;

/// Facts about a file that its head and the list share.
struct ZippedFile {
  std::string name;
  std::chrono::sys_seconds time;
  std::uint32_t crc = 0, size = 0;

  void append_to(Bytes& out) const {
    const std::tm moment = hal::calendar_time(time);
    const auto clock =
        static_cast<std::uint16_t>(moment.tm_hour << 11 | moment.tm_min << 5 | moment.tm_sec / 2);
    const auto date = static_cast<std::uint16_t>((moment.tm_year - 80) << 9 |
                                                 (moment.tm_mon + 1) << 5 | moment.tm_mday);
    FieldWriter fields(out);
    fields(kVersion, kUtf8Names, kStored, clock, date, crc, size, size,
           static_cast<std::uint16_t>(name.size()), kNothing);
  }
};

void append_text(Bytes& out, const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  out.insert(out.end(), bytes.begin(), bytes.end());
}

Bytes local_head(const ZippedFile& file) {
  Bytes head;
  FieldWriter fields(head);
  fields(kLocalHead);
  file.append_to(head);
  append_text(head, file.name);
  return head;
}

/// Copies a file and computes its checksum.
Result<std::uint32_t> append_content(ExportFile& out, const hal::mcap::File& file,
                                     std::uint64_t size, const ExportSteps& steps) {
  Bytes buffer(kMebibyte);
  std::uint32_t crc = 0;
  for (std::uint64_t at = 0; at < size;) {
    if (!steps(at / kMebibyte, size / kMebibyte, "MiB archived")) return cancelled_export();
    const auto part = std::span(buffer).first(
        static_cast<std::size_t>(std::min<std::uint64_t>(buffer.size(), size - at)));
    if (const auto read = file.read(at, part); !read) return fail(read.error().message);
    if (const auto written = out.append(part); !written) return tl::unexpected(written.error());
    crc = hal::mcap::crc32_of(part, crc);
    at += part.size();
  }
  return crc;
}

}  // namespace

Result<ZipWriter> ZipWriter::create(const std::filesystem::path& path,
                                    std::chrono::sys_seconds now) {
  return ExportFile::create(path).map(
      [now](ExportFile file) { return ZipWriter(std::move(file), now); });
}

Result<> ZipWriter::add(const std::string& name, const std::filesystem::path& file,
                        const ExportSteps& steps) {
  const auto opened = hal::mcap::File::open(file, hal::mcap::File::Access::Read);
  if (!opened) return fail(opened.error().message);
  const auto size = opened->size();
  if (!size) return fail(size.error().message);
  // The rest is for heads and list.
  if (file_.size() + *size + list_.size() + kMebibyte > kMostOfZip) {
    return fail("ZIP has at most 4 GiB; choose a smaller range by --from and --to");
  }
  ZippedFile zipped{name, now_, 0, static_cast<std::uint32_t>(*size)};
  const std::uint64_t place = file_.size();
  if (auto written = file_.append(local_head(zipped)); !written) return written;
  const auto crc = append_content(file_, *opened, *size, steps);
  if (!crc) return tl::unexpected(crc.error());
  zipped.crc = *crc;
  FieldWriter fields(list_);
  fields(kListHead, kMadeOnUnix);
  zipped.append_to(list_);
  fields(kNothing, kNothing, kNothing, kRegularFile, static_cast<std::uint32_t>(place));
  append_text(list_, name);
  ++files_;
  return file_.replace(place, local_head(zipped));
}

Result<> ZipWriter::finish() {
  const auto place = static_cast<std::uint32_t>(file_.size());
  const auto size = static_cast<std::uint32_t>(list_.size());
  FieldWriter fields(list_);
  fields(kListEnd, kNothing, kNothing, files_, files_, size, place, kNothing);
  return file_.append(list_).and_then([this] { return file_.sync(); });
}

}  // namespace orbwatch::app::recorder
