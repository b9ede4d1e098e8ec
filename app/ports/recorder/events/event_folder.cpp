// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_folder.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <utility>

#include "app/log.h"
#include "app/ports/recorder/disk_space.h"
#include "app/ports/recorder/events/event_name.h"
#include "app/ports/recorder/events/event_summary.h"
#include "app/ports/recorder/folder_change.h"
#include "app/ports/recorder/recorded_utc.h"
#include "hal/atomic_file.h"
#include "hal/mcap/completion.h"
#include "hal/mcap/file.h"
#include "hal/mcap/reader.h"
#include "hal/recording/topics.h"

namespace orbwatch::app::recorder {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kUnfinished = ".unfinished", kDeleted = ".deleted",
                           kRestoring = ".restoring";

tl::unexpected<Error> failure(const fs::path& path, const std::error_code& error) {
  return fail(path.string() + ": " + error.message());
}

/// Name of the event of a folder with this ending; empty: another one.
std::string name_before(const fs::path& folder, std::string_view ending) {
  std::string name = folder.filename().string();
  if (!name.ends_with(ending)) return {};
  name.resize(name.size() - ending.size());
  return is_event_name(name) ? name : std::string();
}

/// True: a restore was interrupted. A restore of one event takes less than an hour.
bool is_left_behind(const fs::path& folder) {
  std::error_code unknown;
  const auto changed = fs::last_write_time(folder, unknown);
  return !name_before(folder, kRestoring).empty() && !unknown &&
         changed < fs::file_time_type::clock::now() - std::chrono::hours(1);
}

StoredEvent stored(const fs::path& folder, std::string name, bool is_finished) {
  const auto changed = settled_change(folder);  // before it is read
  std::error_code none;
  return {std::move(name), folder, bytes_in(folder), fs::exists(folder / kEventPin, none),
          is_finished,     changed};
}

/// False: the event has no pin for certain.
bool may_be_pinned(const fs::path& folder) {
  std::error_code unknown;
  return fs::exists(folder / kEventPin, unknown) || unknown;
}

/// The event of this folder in a list, if its folder has not changed since; null otherwise.
const StoredEvent* unchanged(std::span<const StoredEvent> known, const fs::path& folder,
                             const std::string& name) {
  const auto found = std::ranges::lower_bound(known, name, {}, &StoredEvent::name);
  const bool is_same = found != known.end() && found->folder == folder && found->changed &&
                       found->changed == settled_change(folder);
  return is_same ? &*found : nullptr;
}

/// Completes the summary that was written at the start by what the recording has.
Result<> update_summary(const fs::path& folder) {
  const auto reader = hal::mcap::Reader::open(folder / kEventFile);
  if (!reader) return fail(reader.error().message);
  auto summary = read_summary(folder);
  if (!summary) return tl::unexpected(summary.error());
  const hal::mcap::Summary& recorded = reader->summary();
  const hal::mcap::Statistics statistics = recorded.statistics();
  summary->first = utc_text_at(statistics.message_start_time);
  summary->last = utc_text_at(statistics.message_end_time);
  for (const auto& [id, count] : recorded.message_counts) {
    const std::string& topic = recorded.channels.at(id).topic;
    if (topic.ends_with("/camera_info")) continue;
    const auto camera = hal::recording::camera_of(topic);
    for (auto& [name, pictures] : summary->pictures) pictures = camera == name ? count : pictures;
  }
  summary->is_interrupted = true;
  return write_summary(folder, *summary);
}

}  // namespace

Result<> EventFolder::prepare() {
  std::error_code error;
  std::vector<fs::path> folders;
  if (!fs::exists(root_, error) && !error) return {};
  for (fs::directory_iterator it(root_, error), end; !error && it != end; it.increment(error)) {
    folders.push_back(it->path());
  }
  if (error) return failure(root_, error);
  for (const fs::path& folder : folders) {
    if (refused_.contains(folder)) continue;
    const bool is_deleted = !name_before(folder, kDeleted).empty();
    if (is_deleted && may_be_pinned(folder)) {
      undo_deletion(folder);
    } else if (is_deleted || is_left_behind(folder)) {
      end_deletion(folder);
    }
    if (name_before(folder, kUnfinished).empty()) continue;
    const auto recovered = recover(folder);
    if (!recovered && is_full(root_)) return recovered;
    if (!recovered && !logged_.insert(folder).second) continue;
    log_line(recovered ? LogLevel::Info : LogLevel::Warning,
             "recorder: " + folder.string() +
                 (recovered ? " was not recorded to its end; what there is of it is kept"
                            : " cannot be finished: " + recovered.error().message));
  }
  return {};
}

void EventFolder::end_deletion(const fs::path& folder) {
  std::error_code error;
  fs::remove_all(folder, error);
  if (!error || !logged_.insert(folder).second) return;
  log_line(LogLevel::Warning,
           "recorder: " + folder.string() + " cannot be deleted: " + error.message());
}

/// Gives an event its name back that was pinned before its deletion for room began; that was
/// interrupted before it came to the pin.
void EventFolder::undo_deletion(const fs::path& folder) {
  const auto kept = finish(folder);
  if (!kept && !logged_.insert(folder).second) return;
  log_line(kept ? LogLevel::Info : LogLevel::Warning,
           "recorder: " + folder.string() +
               (kept ? " is or may be pinned, so its deletion is undone"
                     : " is or may be pinned, but its deletion cannot be undone: " +
                           kept.error().message));
}

/// An event without a recording, because its recorder ended while it made the folder, is deleted.
Result<> EventFolder::recover(const fs::path& unfinished) {
  std::error_code error;
  if (auto removed = hal::remove_unfinished(unfinished); !removed) return removed;
  const bool has_recording =
      fs::exists(unfinished / kEventSummary, error) && fs::exists(unfinished / kEventFile, error);
  if (!has_recording && !error) {
    fs::remove_all(unfinished, error);
    if (!error) return {};
  }
  if (error) return failure(unfinished, error);
  const auto completed = hal::mcap::complete(unfinished / kEventFile);
  if (!completed && completed.error().number == 0) refused_.insert(unfinished);
  if (!completed) return fail(completed.error().message);
  return update_summary(unfinished).and_then([&] { return finish(unfinished); });
}

Result<std::vector<StoredEvent>> EventFolder::list(std::span<const StoredEvent> known) const {
  std::vector<StoredEvent> events;
  std::error_code error;
  if (!fs::exists(root_, error) && !error) return events;
  for (fs::directory_iterator it(root_, error), end; !error && it != end; it.increment(error)) {
    const fs::path& folder = it->path();
    std::string name = name_before(folder, "");
    const bool is_finished = !name.empty();
    if (!is_finished) name = name_before(folder, kUnfinished);
    std::error_code none;
    if (name.empty() || !it->is_directory(none)) continue;
    const StoredEvent* const same = unchanged(known, folder, name);
    events.push_back(same ? *same : stored(folder, std::move(name), is_finished));
  }
  if (error) return failure(root_, error);
  std::ranges::sort(events, {}, &StoredEvent::name);
  return events;
}

Result<StoredEvent> EventFolder::find(std::string_view name) const {
  if (!is_event_name(name)) {
    return fail("\"" + std::string(name) +
                "\" is not the name of an event, such as 20261128T092200.125Z-alarm");
  }
  // In the order of an event's life: it may be finished in between.
  for (const bool is_finished : {false, true}) {
    const fs::path folder = root_ / std::string(name).append(is_finished ? "" : kUnfinished);
    std::error_code none;
    if (fs::is_directory(folder, none)) return stored(folder, std::string(name), is_finished);
  }
  return fail("there is no event " + std::string(name) + " in " + root_.string());
}

Result<fs::path> EventFolder::begin(Utc triggered, TriggerKind trigger) const {
  const std::string name = event_name(triggered, trigger);
  std::error_code error;
  const auto exists = [&](const std::string& one) {
    return fs::exists(root_ / one, error) || fs::exists(root_ / (one + kUnfinished.data()), error);
  };
  std::string unique = name;
  for (int n = 2; exists(unique); ++n) unique = name + "-" + std::to_string(n);
  const fs::path folder = root_ / (unique + kUnfinished.data());
  fs::create_directories(folder, error);
  if (error) return failure(folder, error);
  return folder;
}

fs::path EventFolder::restoring(const std::string& name) const {
  return root_ / (name + kRestoring.data());
}

Result<> EventFolder::finish(const fs::path& unfinished) const {
  std::error_code error;
  fs::rename(unfinished, root_ / unfinished.stem(), error);
  if (error) return failure(unfinished, error);
  return hal::sync_folder(root_);
}

/// A recorder locks the file until the event ends; a new file may not be locked yet. A file that
/// cannot be opened for any other reason, such as too many open files, may be locked.
bool EventFolder::is_being_recorded(const StoredEvent& event) {
  constexpr std::chrono::minutes kMoment{1};
  if (event.is_finished) return false;
  std::error_code error;
  const auto changed = fs::last_write_time(event.folder / kEventFile, error);
  const auto age = fs::file_time_type::clock::now() - changed;
  if (error || std::chrono::abs(age) < kMoment) return true;
  const auto opened =
      hal::mcap::File::open(event.folder / kEventFile, hal::mcap::File::Access::Change);
  return !opened;
}

Result<> EventFolder::check_finished(const StoredEvent& event) {
  if (event.is_finished) return {};
  if (is_being_recorded(event)) {
    return fail("the event " + event.name + " is being recorded; export it afterwards");
  }
  return fail("the event " + event.name +
              " is not complete, since its recorder ended early; orbwatchd completes it when it "
              "starts with these recordings, and orbwatch events rm deletes it");
}

/// Gives an event the name of one that is being deleted, under which no pin reaches it any more.
Result<fs::path> EventFolder::doom(const StoredEvent& event) const {
  std::error_code error;
  fs::path doomed = root_ / (event.name + kDeleted.data());
  fs::rename(event.folder, doomed, error);
  if (error) return failure(event.folder, error);
  return doomed;
}

Result<> EventFolder::remove(const StoredEvent& event) const {
  return doom(event).and_then([&](const fs::path& doomed) -> Result<> {
    std::error_code error;
    fs::remove(doomed / kEventPin, error);  // with it, an interrupted deletion is undone
    if (!error) fs::remove_all(doomed, error);
    if (error) return failure(event.folder, error);
    return {};
  });
}

Result<bool> EventFolder::remove_unless_pinned(const StoredEvent& event) const {
  return doom(event).and_then([&](const fs::path& doomed) -> Result<bool> {
    if (may_be_pinned(doomed)) return finish(doomed).map([] { return false; });
    std::error_code error;
    fs::remove_all(doomed, error);
    if (error) return failure(event.folder, error);
    return true;
  });
}

Result<> EventFolder::set_pinned(const StoredEvent& event, bool is_pinned) {
  std::error_code error;
  if (is_pinned) {
    auto written = hal::write_file(event.folder / kEventPin, std::string_view());
    if (!written) return written;
  } else if (!fs::remove(event.folder / kEventPin, error) && error) {
    return failure(event.folder, error);
  }
  const fs::path root = event.folder.parent_path();
  if (::utimensat(AT_FDCWD, root.c_str(), nullptr, 0) == 0) return {};
  return failure(root, {errno, std::generic_category()});
}

}  // namespace orbwatch::app::recorder
