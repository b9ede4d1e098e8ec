// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/events/kept_events.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/cli/archive/tar_header.h"
#include "app/cli/backup/events/event_files.h"
#include "hal/regular_file.h"

namespace orbwatch::app::cli::backup {
namespace {

namespace fs = std::filesystem;
using recorder::StoredEvent;

constexpr mode_t kReadable = 0640;

tl::unexpected<Error> not_read(const fs::path& file) {
  return fail(file.string() + ": cannot be read: " + std::system_category().message(errno));
}

std::string filling(std::uint64_t size) { return std::string(tar_padded(size) - size, '\0'); }

tl::unexpected<Error> changed(const StoredEvent& event) {
  return fail(event.folder.string() + ": was changed meanwhile; try again");
}

/// Writes a file of an event as an entry. Returns its size.
Result<std::uint64_t> write_entry(const StoredEvent& event, std::string_view file_name,
                                  FrameWriter& frame) {
  const fs::path file = event.folder / file_name;
  const hal::FileDescriptor opened = hal::open_no_link(file);
  struct stat about {};
  if (!opened.is_open() && errno == ENOENT) return 0;
  if (!opened.is_open() || ::fstat(opened.get(), &about) != 0) return not_read(file);
  if (!S_ISREG(about.st_mode)) return fail(file.string() + ": is not a regular file");
  const auto size = static_cast<std::uint64_t>(about.st_size);
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  const std::string name = name_above(event.name).append(file_name);
  auto done = tar_header({name, size, kReadable}, now).and_then([&](const std::string& header) {
    return frame.add(header);
  });
  std::string part(kEventPart, '\0');
  for (std::uint64_t left = size; done && left > 0;) {
    const ssize_t count =
        ::read(opened.get(), part.data(), std::min<std::uint64_t>(part.size(), left));
    if (count < 0) return not_read(file);
    if (count == 0) return changed(event);
    done = frame.add(std::string_view(part).substr(0, static_cast<std::size_t>(count)));
    left -= static_cast<std::uint64_t>(count);
  }
  return done.and_then([&] { return frame.add(filling(size)); }).map([&] { return size; });
}

/// Writes an event as a frame.
Result<> write_event(const StoredEvent& event, const ManifestEvent& stated,
                     const FrameWriter::Sink& sink) {
  FrameWriter frame(sink);
  std::uint64_t bytes = 0;
  for (const std::string_view file : kEventFiles) {
    const auto size = write_entry(event, file, frame);
    if (!size) return tl::unexpected(size.error());
    bytes += *size;
  }
  if (bytes != stated.bytes) return changed(event);
  constexpr std::size_t kEndBlocks = 2;
  return frame.add(std::string(kEndBlocks * kTarBlock, '\0')).and_then([&] {
    return frame.finish();
  });
}

}  // namespace

Result<std::vector<StoredEvent>> kept_events(std::vector<StoredEvent> events,
                                             std::vector<std::string>& left_out) {
  std::vector<StoredEvent> kept;
  for (StoredEvent& event : events) {
    if (::access(event.folder.c_str(), R_OK | X_OK) != 0) {
      if (errno == ENOENT) continue;
      return not_read(event.folder);
    }
    if (!event.is_pinned || !event.is_finished) continue;
    std::error_code none;
    if (fs::exists(event.folder / recorder::kEventFile, none)) {
      kept.push_back(std::move(event));
    } else {
      left_out.push_back(event.folder.string() + ": has no " + recorder::kEventFile);
    }
  }
  return kept;
}

std::vector<ManifestEvent> manifest_events(std::span<const StoredEvent> events) {
  std::vector<ManifestEvent> all;
  for (const StoredEvent& event : events) {
    std::uint64_t bytes = 0;
    for (const std::string_view file : kEventFiles) {
      std::error_code absent;
      const std::uintmax_t size = fs::file_size(event.folder / file, absent);
      if (!absent) bytes += size;
    }
    all.push_back({event.name, bytes});
  }
  return all;
}

Result<> write_events(std::span<const StoredEvent> events, const std::vector<ManifestEvent>& stated,
                      const FrameWriter::Sink& sink) {
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (auto written = write_event(events[i], stated[i], sink); !written) return written;
  }
  return {};
}

}  // namespace orbwatch::app::cli::backup
