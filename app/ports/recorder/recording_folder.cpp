// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/recording_folder.h"

#include <algorithm>
#include <ctime>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/log.h"
#include "app/ports/recorder/disk_space.h"
#include "app/ports/recorder/events/event_name.h"
#include "app/ports/recorder/folder_change.h"
#include "hal/calendar_time.h"
#include "hal/mcap/completion.h"

namespace orbwatch::app::recorder {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kLogName = "log-";
constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20;

bool is_recording(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with(kLogName) && name.ends_with(".mcap");
}

std::string text_of(const fs::path& folder, const std::error_code& error) {
  return folder.string() + ": " + error.message();
}

}  // namespace

Result<> RecordingFolder::prepare() {
  std::error_code error;
  fs::create_directories(settings_.folder, error);
  if (error) return fail(text_of(settings_.folder, error));
  const auto recordings = list();
  if (!recordings) return tl::unexpected(recordings.error());
  for (const Recording& recording : *recordings) {
    if (unfinished_.contains(recording.file)) continue;
    const auto completed = hal::mcap::complete(recording.file);
    if (!completed && is_full(settings_.folder)) return fail(completed.error().message);
    if (!completed) {
      unfinished_.insert(recording.file);
      log_line(LogLevel::Warning, "recorder: " + recording.file.string() +
                                      " cannot be finished: " + completed.error().message);
    } else if (!completed->was_finished) {
      log_line(LogLevel::Info, "recorder: finished " + recording.file.string() +
                                   ", which an earlier run did not end");
    }
  }
  return events_.prepare();
}

Result<std::vector<Recording>> RecordingFolder::list() const {
  std::vector<Recording> all;
  std::error_code error;
  for (fs::directory_iterator it(settings_.folder, error), end; !error && it != end;
       it.increment(error)) {
    std::error_code vanished;
    if (!is_recording(it->path()) || !it->is_regular_file(vanished)) continue;
    const std::uint64_t bytes = it->file_size(vanished);
    if (!vanished) all.push_back({it->path(), bytes});
  }
  if (error) return fail(text_of(settings_.folder, error));
  std::ranges::sort(all, {}, &Recording::file);
  return all;
}

fs::path RecordingFolder::name_for(std::chrono::system_clock::time_point utc) const {
  const std::tm fields = hal::calendar_time(std::chrono::floor<std::chrono::seconds>(utc));
  char text[32];
  std::strftime(text, sizeof text, "log-%Y%m%dT%H%M%SZ", &fields);
  fs::path file = settings_.folder / (std::string(text) + ".mcap");
  std::error_code none;
  for (int n = 2; fs::exists(file, none); ++n) {
    file = settings_.folder / (std::string(text) + "-" + std::to_string(n) + ".mcap");
  }
  return file;
}

/// Follows the folder.
Result<> RecordingFolder::update(const fs::path& current) {
  const auto changed = settled_change(settings_.folder);
  const bool has_other_logs = !changed || changed != changed_ || current != current_;
  if (has_other_logs) {
    auto logs = list();
    if (!logs) return tl::unexpected(logs.error());
    logs_ = std::move(*logs);
    changed_ = changed;
    current_ = current;
  }
  const auto has_other_events = index_.update();
  if (!has_other_events) return tl::unexpected(has_other_events.error());
  if (!has_other_logs && !*has_other_events) return {};
  still_bytes_ = 0;
  for (const Recording& log : logs_) still_bytes_ += log.file == current_ ? 0 : log.bytes;
  for (const StoredEvent& event : index_.events()) {
    still_bytes_ += event.is_finished ? event.bytes : 0;
  }
  return {};
}

/// Bytes of all recordings.
std::uint64_t RecordingFolder::bytes() const {
  std::error_code error;
  const std::uintmax_t current = fs::file_size(current_, error);
  std::uint64_t bytes = still_bytes_ + (error ? 0 : current);
  for (const StoredEvent& event : index_.unfinished()) {
    const auto grown = events_.find(event.name);
    bytes += grown ? grown->bytes : 0;
  }
  return bytes;
}

/// Recordings that may be deleted, the oldest first.
std::vector<RecordingFolder::Deletable> RecordingFolder::deletable() const {
  std::vector<Deletable> deletable;
  for (const Recording& log : logs_) {
    if (log.file == current_) continue;
    const auto remove = [file = log.file]() -> Result<bool> {
      std::error_code error;
      if (!fs::remove(file, error) && error) return fail(text_of(file, error));
      return true;
    };
    const std::string name = log.file.filename().string().substr(kLogName.size());
    deletable.push_back({name, log.bytes, remove});
  }
  for (const StoredEvent& event : index_.events()) {
    if (event.is_pinned || !event.is_finished) continue;
    deletable.push_back({event.name, event.bytes, [this, &event] { return remove(event); }});
  }
  std::ranges::sort(deletable, {}, &Deletable::begun);
  return deletable;
}

/// Deletes an event. False: it was pinned since it was listed.
Result<bool> RecordingFolder::remove(const StoredEvent& listed) const {
  const auto event = events_.find(listed.name);
  if (!event) return true;  // another program was quicker
  if (event->is_pinned || !event->is_finished) return false;
  return events_.remove(*event).map([] { return true; });
}

/// Deletes events whose trigger is too long ago. Before 1970, as without a battery for the clock,
/// none is.
Result<int> RecordingFolder::remove_old(std::chrono::system_clock::time_point utc) const {
  constexpr int kMostAtOnce = 10;
  const std::chrono::days limit{settings_.events ? settings_.events->keep_days : 0};
  if (limit.count() == 0 || utc - limit <= Utc{}) return 0;
  const std::string oldest = event_name(utc - limit, TriggerKind::Alarm);
  int removed = 0;
  for (const StoredEvent& event : index_.events()) {
    if (event.name >= oldest || removed == kMostAtOnce) break;
    if (event.is_pinned || !event.is_finished) continue;
    const auto done = remove(event);
    if (!done) return tl::unexpected(done.error());
    removed += *done ? 1 : 0;
  }
  return removed;
}

Result<int> RecordingFolder::make_room(const fs::path& current,
                                       std::chrono::system_clock::time_point utc) {
  const auto old = update(current).and_then([&] { return remove_old(utc); });
  if (!old) return old;
  return update(current).and_then([this] { return remove_for_room(); }).map([&](int removed) {
    return *old + removed;
  });
}

Result<int> RecordingFolder::remove_for_room() const {
  const auto limit = static_cast<std::uint64_t>(settings_.limit_mib) * kMebibyte;
  const auto reserve = static_cast<std::uint64_t>(settings_.reserve_mib) * kMebibyte;
  std::uint64_t left = bytes();
  std::optional<std::vector<Deletable>> all;
  std::size_t oldest = 0;
  int removed = 0;
  for (;;) {
    std::error_code error;
    const fs::space_info space = fs::space(settings_.folder, error);
    if (error) return fail(text_of(settings_.folder, error));
    const bool is_short = space.available < reserve;
    if (left <= limit && !is_short) return removed;
    if (!all) all = deletable();
    if (oldest == all->size()) {
      if (!is_short) return removed;
      return fail(settings_.folder.string() + " has " +
                  std::to_string(space.available / kMebibyte) +
                  " MiB left, less than reserve_mib, and no recording to delete");
    }
    const auto done = (*all)[oldest].remove();
    if (!done) return tl::unexpected(done.error());
    left -= *done ? (*all)[oldest].bytes : 0;
    removed += *done ? 1 : 0;
    ++oldest;
  }
}

}  // namespace orbwatch::app::recorder
