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
#include "app/cli/backup/as_owner.h"
#include "app/ports/recorder/events/event_name.h"
#include "app/ports/recorder/events/event_summary.h"
#include "hal/atomic_file.h"
#include "hal/regular_file.h"

namespace orbwatch::app::cli::backup {
namespace {

namespace fs = std::filesystem;
using recorder::EventFolder;
using recorder::StoredEvent;

/// More do not fit into a folder that people look at.
constexpr std::size_t kMostEvents = 10'000;
constexpr std::array<std::string_view, 4> kFiles{recorder::kEventFile, recorder::kEventSummary,
                                                 recorder::kEventPicture, recorder::kEventPin};
constexpr std::size_t kPart = std::size_t{128} << 10;
constexpr mode_t kReadable = 0640;

tl::unexpected<Error> not_read(const fs::path& file) {
  return fail(file.string() + ": cannot be read: " + std::system_category().message(errno));
}

/// What the names of an event's files begin with.
std::string name_above(const std::string& event) { return "events/" + event + "/"; }

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
  std::string part(kPart, '\0');
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
  for (const std::string_view file : kFiles) {
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

/// Reads the frame of an event, and writes its files into a folder; without one it is only checked.
class EventReader {
 public:
  EventReader(FrameReader& frames, const ManifestEvent& event, fs::path staged)
      : frames_(frames),
        above_(name_above(event.name)),
        left_(event.bytes),
        staged_(std::move(staged)) {}

  Result<> read() {
    while (true) {
      auto block = read_block();
      if (!block) return tl::unexpected(block.error());
      if (*block == std::string(kTarBlock, '\0')) break;
      auto taken =
          parse_tar_header(*block).and_then([this](const TarEntry& entry) { return take(entry); });
      if (!taken) return taken;
    }
    if (left_ > 0 || !files_.contains(recorder::kEventFile)) return damaged();
    return read_end();
  }

 private:
  static tl::unexpected<Error> damaged() {
    return fail("is damaged: its events are not those of the manifest");
  }

  Result<std::string> read_block() {
    std::string block(kTarBlock, '\0');
    const auto count = frames_.read(block);
    if (!count) return tl::unexpected(count.error());
    if (*count < kTarBlock) return fail("is cut off");
    return block;
  }

  /// Reads the second block of the end; the frame's checksum is that of all its bytes.
  Result<> read_end() {
    const auto block = read_block();
    if (!block) return tl::unexpected(block.error());
    std::array<char, 1> more{};
    const auto count = frames_.read(more);
    if (!count) return tl::unexpected(count.error());
    if (*count > 0 || *block != std::string(kTarBlock, '\0')) return damaged();
    return {};
  }

  Result<> take(const TarEntry& entry) {
    const std::string file = entry.name.substr(std::min(above_.size(), entry.name.size()));
    const bool is_right = entry.name.starts_with(above_) && entry.size <= left_ &&
                          std::ranges::count(kFiles, file) > 0 && files_.insert(file).second;
    if (!is_right) return damaged();
    left_ -= entry.size;
    if (staged_.empty()) return copy(entry.size, [](std::string_view) { return Result<>(); });
    auto written = hal::AtomicFile::create(staged_ / file, hal::FileAccess::Folder);
    if (!written) return tl::unexpected(written.error());
    return copy(entry.size, [&](std::string_view part) { return written->write(part); })
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
  const std::string above_;  ///< what the names of its files begin with
  std::uint64_t left_;       ///< bytes of its files that are still to come
  const fs::path staged_;
  std::set<std::string> files_;
};

/// Adds an event that is not there yet.
Result<> add_event(FrameReader& frames, const ManifestEvent& event, const EventFolder& folder,
                   DiskChanges& disk) {
  const fs::path staged = folder.restoring(event.name);
  std::error_code none;
  fs::remove_all(staged, none);  // of a restore that was interrupted
  auto added = disk.make_folder(staged)
                   .and_then([&] { return EventReader(frames, event, staged).read(); })
                   .and_then([&] { return folder.finish(staged); });
  fs::remove_all(staged, none);
  return added;
}

/// Reads the frames of all events, the first of which has begun.
Result<> read_events(FrameReader& frames, const std::vector<ManifestEvent>& events,
                     const std::function<Result<>(const ManifestEvent&)>& read) {
  for (const ManifestEvent& event : events) {
    if (&event != &events.front()) {
      const auto next = frames.next();
      if (!next) return tl::unexpected(next.error());
      if (!*next) return fail("is cut off: events are missing");
    }
    if (auto done = read(event); !done) return done;
  }
  const auto more = frames.next();
  if (!more) return tl::unexpected(more.error());
  if (*more) return fail("is damaged: other bytes follow its events");
  return {};
}

/// The folder, or the nearest one above it that exists.
fs::path existing(fs::path folder) {
  std::error_code none;
  while (!fs::exists(folder, none) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

/// Rounded up.
std::string mebibytes(std::uint64_t bytes) {
  return std::to_string((bytes >> 20) + ((bytes & 0xFFFFF) != 0 ? 1 : 0)) + " MiB";
}

}  // namespace

Result<std::vector<StoredEvent>> kept_events(const fs::path& recordings,
                                             std::vector<std::string>& left_out) {
  auto events = EventFolder(recordings).list();
  if (!events) return events;
  std::vector<StoredEvent> kept;
  for (StoredEvent& event : *events) {
    if (::access(event.folder.c_str(), R_OK | X_OK) != 0) return not_read(event.folder);
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
  if (events.empty()) return {};
  std::uint64_t wanted = reserve;
  for (const ManifestEvent& event : events) {
    if (event.bytes > std::numeric_limits<std::uint64_t>::max() - wanted) {
      return fail("is damaged: its events are too large");
    }
    wanted += event.bytes;
  }
  std::error_code error;
  const std::uintmax_t free = fs::space(existing(folder), error).available;
  if (error) return fail(folder.string() + ": " + error.message());
  if (wanted <= free) return {};
  return fail(folder.string() + ": has no room for the events: " + mebibytes(wanted) +
              " are needed, " + mebibytes(reserve) + " of them for reserve_mib, and " +
              std::to_string(free >> 20) + " MiB are free");
}

Result<> write_events(std::span<const StoredEvent> events, const std::vector<ManifestEvent>& stated,
                      const FrameWriter::Sink& sink) {
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (auto written = write_event(events[i], stated[i], sink); !written) return written;
  }
  return {};
}

Result<> check_events(const std::vector<ManifestEvent>& events) {
  const bool are_names = std::ranges::all_of(events, recorder::is_event_name, &ManifestEvent::name);
  const auto out_of_order =
      std::ranges::adjacent_find(events, std::ranges::greater_equal(), &ManifestEvent::name);
  if (events.size() > kMostEvents) {
    return fail("has more than " + std::to_string(kMostEvents) + " events");
  }
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

Result<> check_frames(FrameReader& frames, const std::vector<ManifestEvent>& events,
                      const EventPlace& place) {
  return check_room(missing_events(events, place), place.recordings, place.reserve).and_then([&] {
    return read_events(frames, events, [&](const ManifestEvent& event) {
      return EventReader(frames, event, {}).read();
    });
  });
}

Result<> place_events(FrameReader& frames, const std::vector<ManifestEvent>& events,
                      const EventPlace& place, DiskChanges& disk) {
  if (auto made = make_folders(place.recordings, disk); !made) return made;
  return as_owner_of(place.recordings, [&]() -> Result<> {
    const std::vector<ManifestEvent> missing = missing_events(events, place);
    if (auto room = check_room(missing, place.recordings, place.reserve); !room) return room;
    const EventFolder folder(place.recordings);
    if (auto made = make_folders(folder.path(), disk); !made) return made;
    return read_events(frames, events, [&](const ManifestEvent& event) {
      const bool is_missing =
          std::ranges::binary_search(missing, event.name, {}, &ManifestEvent::name);
      return is_missing ? add_event(frames, event, folder, disk)
                        : EventReader(frames, event, {}).read();
    });
  });
}

}  // namespace orbwatch::app::cli::backup
