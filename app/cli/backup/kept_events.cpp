// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/kept_events.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <functional>
#include <iterator>
#include <limits>
#include <set>
#include <system_error>
#include <utility>

#include "app/cli/archive/tar_header.h"
#include "app/ports/recorder/events/event_name.h"
#include "app/ports/recorder/events/event_summary.h"
#include "hal/atomic_file.h"
#include "hal/regular_file.h"

namespace orbwatch::app::cli::backup {
namespace {

namespace fs = std::filesystem;
using recorder::EventFolder;
using recorder::StoredEvent;

constexpr std::string_view kFolder = "events/";
constexpr std::array<std::string_view, 4> kFiles{recorder::kEventFile, recorder::kEventSummary,
                                                 recorder::kEventPicture, recorder::kEventPin};
constexpr std::size_t kPart = std::size_t{128} << 10;
constexpr mode_t kReadable = 0640;

tl::unexpected<Error> not_read(const fs::path& file) {
  return fail(file.string() + ": cannot be read: " + std::system_category().message(errno));
}

std::string filling(std::uint64_t size) { return std::string(tar_padded(size) - size, '\0'); }

/// Writes a file of an event as an entry.
Result<> write_entry(const fs::path& file, const std::string& name, FrameWriter& frame) {
  const hal::FileDescriptor opened = hal::open_no_link(file);
  struct stat about {};
  if (!opened.is_open() || ::fstat(opened.get(), &about) != 0) return not_read(file);
  if (!S_ISREG(about.st_mode)) return fail(file.string() + ": is not a regular file");
  const auto size = static_cast<std::uint64_t>(about.st_size);
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  auto done = tar_header({name, size, kReadable}, now).and_then([&](const std::string& header) {
    return frame.add(header);
  });
  std::string part(kPart, '\0');
  for (std::uint64_t left = size; done && left > 0;) {
    const ssize_t count =
        ::read(opened.get(), part.data(), std::min<std::uint64_t>(part.size(), left));
    if (count < 0) return not_read(file);
    if (count == 0) return fail(file.string() + ": became shorter meanwhile");
    done = frame.add(std::string_view(part).substr(0, static_cast<std::size_t>(count)));
    left -= static_cast<std::uint64_t>(count);
  }
  return done.and_then([&] { return frame.add(filling(size)); });
}

/// Reads a tar of events from a frame, and writes them.
class Placement {
 public:
  Placement(FrameReader& frames, const EventPlace& place, DiskChanges& disk)
      : frames_(frames), folder_(place.recordings), disk_(disk) {}

  Result<> place(const ManifestEvent& event) {
    std::error_code none;
    const bool is_there = fs::exists(folder_.path() / event.name, none);
    const fs::path staged = folder_.restoring(event.name);
    fs::remove_all(staged, none);  // of a restore that was interrupted
    auto done = is_there ? Result<>() : disk_.make_folder(staged);
    std::set<std::string> files;
    for (std::uint64_t left = event.bytes; done && (left > 0 || is_next_of(event));) {
      done = take_entry(event, left, files, is_there ? fs::path() : staged);
    }
    if (done && !files.contains(recorder::kEventFile)) done = damaged();
    if (done && !is_there) done = folder_.finish(staged);
    fs::remove_all(staged, none);
    return done;
  }

  /// Error: something follows the events.
  Result<> finish() {
    if (auto read = read_header(); !read) return read;
    if (header_ != std::string(kTarBlock, '\0')) return damaged();
    header_.clear();
    if (auto read = read_header(); !read) return read;
    std::array<char, 1> more{};
    const auto count = frames_.read(more);
    if (!count) return tl::unexpected(count.error());
    if (*count > 0 || header_ != std::string(kTarBlock, '\0')) return damaged();
    const auto next = frames_.next();
    if (!next) return tl::unexpected(next.error());
    if (*next) return damaged();
    return {};
  }

 private:
  static tl::unexpected<Error> damaged() {
    return fail("is damaged: its events are not those of the manifest");
  }

  Result<> read_header() {
    if (!header_.empty()) return {};
    header_.resize(kTarBlock);
    const auto count = frames_.read(header_);
    if (!count) return tl::unexpected(count.error());
    if (*count < kTarBlock) return fail("is cut off");
    return {};
  }

  /// True: the next entry is an empty file of the event.
  bool is_next_of(const ManifestEvent& event) {
    if (!read_header()) return false;
    const auto entry = parse_tar_header(header_);
    return entry && entry->name.starts_with(std::string(kFolder) + event.name + "/");
  }

  /// Takes a file of the event into the folder `staged`; empty: skips it.
  Result<> take_entry(const ManifestEvent& event, std::uint64_t& left, std::set<std::string>& files,
                      const fs::path& staged) {
    if (auto read = read_header(); !read) return read;
    const auto entry = parse_tar_header(std::exchange(header_, {}));
    if (!entry) return tl::unexpected(entry.error());
    const std::string above = std::string(kFolder) + event.name + "/";
    const std::string file = entry->name.substr(std::min(above.size(), entry->name.size()));
    const bool is_right = entry->name.starts_with(above) && entry->size <= left &&
                          std::ranges::count(kFiles, file) > 0 && files.insert(file).second;
    if (!is_right) return damaged();
    left -= entry->size;
    if (staged.empty()) return copy(entry->size, [](std::string_view) { return Result<>(); });
    auto written = hal::AtomicFile::create(staged / file, hal::FileAccess::Folder);
    if (!written) return tl::unexpected(written.error());
    return copy(entry->size, [&](std::string_view part) { return written->write(part); })
        .and_then([&] { return written->place(); });
  }

  /// Passes the bytes of a file on, without those that fill its last block.
  Result<> copy(std::uint64_t size, const FrameWriter::Sink& sink) {
    std::string part(kPart, '\0');
    for (std::uint64_t left = tar_padded(size), bytes = size; left > 0;) {
      const std::size_t wanted = std::min<std::uint64_t>(part.size(), left);
      const auto count = frames_.read(std::span(part).first(wanted));
      if (!count) return tl::unexpected(count.error());
      if (*count < wanted) return fail("is cut off");
      const std::size_t used = std::min<std::uint64_t>(wanted, bytes);
      if (auto done = sink(std::string_view(part).substr(0, used)); !done) return done;
      left -= wanted;
      bytes -= used;
    }
    return {};
  }

  FrameReader& frames_;
  const EventFolder folder_;
  DiskChanges& disk_;
  std::string header_;  ///< of the next entry; empty: not read yet
};

/// Makes the folders of events; what is above recordings must exist. Recordings may be a link to
/// another disk; the service, which owns what is below, may not lead root elsewhere.
Result<> make_event_folder(const EventPlace& place, DiskChanges& disk) {
  std::error_code none;
  const fs::path events = EventFolder(place.recordings).path();
  if (fs::is_symlink(events, none)) return fail(events.string() + ": is a link");
  for (const fs::path& folder : {place.recordings, events}) {
    if (fs::is_directory(folder, none)) continue;
    if (auto made = disk.make_folder(folder); !made) return made;
  }
  return {};
}

}  // namespace

Result<std::vector<StoredEvent>> kept_events(const fs::path& recordings) {
  if (recordings.empty()) return std::vector<StoredEvent>();
  return EventFolder(recordings).list().map([](std::vector<StoredEvent> events) {
    std::erase_if(events, [](const auto& event) { return !event.is_pinned || !event.is_finished; });
    return events;
  });
}

std::vector<ManifestEvent> manifest_events(std::span<const StoredEvent> events) {
  std::vector<ManifestEvent> all;
  for (const StoredEvent& event : events) {
    std::uint64_t bytes = 0;
    for (const std::string_view file : kFiles) {
      std::error_code absent;
      const std::uintmax_t size = fs::file_size(event.folder / file, absent);
      if (!absent) bytes += size;
    }
    all.push_back({event.name, bytes});
  }
  return all;
}

Result<> check_room(const std::vector<ManifestEvent>& events, const fs::path& folder,
                    std::uint64_t reserve) {
  std::uint64_t wanted = 0;
  for (const ManifestEvent& event : events) {
    if (event.bytes > std::numeric_limits<std::uint64_t>::max() - wanted) {
      return fail("is damaged: its events are too large");
    }
    wanted += event.bytes;
  }
  std::error_code error;
  const std::uintmax_t free = fs::space(folder, error).available;
  if (error) return fail(folder.string() + ": " + error.message());
  if (free >= reserve && wanted <= free - reserve) return {};
  return fail(folder.string() + ": has no room for the events: " + std::to_string(wanted >> 20) +
              " MiB beside reserve_mib are needed, " + std::to_string(free >> 20) +
              " MiB are free");
}

Result<> write_events(std::span<const StoredEvent> events, FrameWriter::Sink sink) {
  FrameWriter frame(std::move(sink));
  for (const StoredEvent& event : events) {
    for (const std::string_view file : kFiles) {
      std::error_code none;
      if (!fs::exists(event.folder / file, none)) continue;
      const std::string name = std::string(kFolder) + event.name + "/" + std::string(file);
      if (auto written = write_entry(event.folder / file, name, frame); !written) return written;
    }
  }
  constexpr std::size_t kEndBlocks = 2;
  return frame.add(std::string(kEndBlocks * kTarBlock, '\0')).and_then([&] {
    return frame.finish();
  });
}

Result<> check_events(const std::vector<ManifestEvent>& events) {
  const bool are_names = std::ranges::all_of(events, recorder::is_event_name, &ManifestEvent::name);
  const auto out_of_order =
      std::ranges::adjacent_find(events, std::ranges::greater_equal(), &ManifestEvent::name);
  if (are_names && out_of_order == events.end()) return {};
  return fail("is damaged: its list of events is not right");
}

std::vector<ManifestEvent> missing_events(const std::vector<ManifestEvent>& events,
                                          const EventPlace& place) {
  std::vector<ManifestEvent> missing;
  const EventFolder folder(place.recordings);
  std::ranges::copy_if(events, std::back_inserter(missing), [&](const ManifestEvent& event) {
    std::error_code none;
    return !fs::exists(folder.path() / event.name, none);
  });
  return missing;
}

Result<> place_events(FrameReader& frames, const std::vector<ManifestEvent>& events,
                      const EventPlace& place, DiskChanges& disk) {
  if (auto made = make_event_folder(place, disk); !made) return made;
  if (auto room = check_room(missing_events(events, place), place.recordings, place.reserve); !room)
    return room;
  Placement placement(frames, place, disk);
  for (const ManifestEvent& event : events) {
    if (auto placed = placement.place(event); !placed) return placed;
  }
  return placement.finish();
}

}  // namespace orbwatch::app::cli::backup
