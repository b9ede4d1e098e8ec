// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/events/restored_events.h"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <functional>
#include <iterator>
#include <set>
#include <system_error>
#include <utility>

#include "app/cli/archive/tar_header.h"
#include "app/cli/backup/as_owner.h"
#include "app/cli/backup/events/event_files.h"
#include "app/cli/backup/events/event_room.h"
#include "app/ports/recorder/events/event_folder.h"
#include "app/ports/recorder/events/event_name.h"
#include "hal/atomic_file.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::cli::backup {
namespace {

namespace fs = std::filesystem;
using recorder::EventFolder;

/// More do not fit into a folder that people look at.
constexpr std::size_t kMostEvents = 10'000;

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
                          std::ranges::count(kEventFiles, file) > 0 && files_.insert(file).second;
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
    std::string part(kEventPart, '\0');
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
  const std::string above_;  ///< beginning of its files' names
  std::uint64_t left_;       ///< bytes of its files that are still to come
  const fs::path staged_;
  std::set<std::string> files_;
};

/// Excludes another restore into the folder while the descriptor is open: each removes the
/// unfinished events of one that was interrupted. Errors: one runs; as the folder has them.
Result<hal::FileDescriptor> exclude_restore(const fs::path& events) {
  hal::FileDescriptor folder(::open(events.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.is_open() && ::flock(folder.get(), LOCK_EX | LOCK_NB) == 0) return folder;
  if (errno == EWOULDBLOCK) {
    return fail(events.string() + ": another restore adds events; repeat this one afterwards");
  }
  return fail(events.string() + ": cannot be locked: " + std::system_category().message(errno));
}

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

}  // namespace

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
    const EventFolder folder(place.recordings);
    if (auto made = make_folders(folder.path(), disk); !made) return made;
    const auto excluded = exclude_restore(folder.path());
    if (!excluded) return tl::unexpected(excluded.error());
    const std::vector<ManifestEvent> missing = missing_events(events, place);
    if (auto room = check_room(missing, place.recordings, place.reserve); !room) return room;
    return read_events(frames, events, [&](const ManifestEvent& event) {
      const bool is_missing =
          std::ranges::binary_search(missing, event.name, {}, &ManifestEvent::name);
      return is_missing ? add_event(frames, event, folder, disk)
                        : EventReader(frames, event, {}).read();
    });
  });
}

}  // namespace orbwatch::app::cli::backup
