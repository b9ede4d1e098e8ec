// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/recording_folder.h"

#include <algorithm>
#include <ctime>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/log.h"
#include "app/model/status/utc_text.h"
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

std::string mebibytes(std::uint64_t bytes) { return std::to_string(bytes / kMebibyte) + " MiB"; }

}  // namespace

Result<> RecordingFolder::prepare() {
  std::error_code error;
  fs::create_directories(settings_.folder, error);
  if (error) return fail(text_of(settings_.folder, error));
  const auto recordings = list();
  if (!recordings) return tl::unexpected(recordings.error());
  for (const Recording& recording : *recordings) {
    if (refused_.contains(recording.file)) continue;
    const auto completed = hal::mcap::complete(recording.file);
    if (!completed && is_full(settings_.folder)) return fail(completed.error().message);
    if (!completed) {
      if (completed.error().number == 0) refused_.insert(recording.file);
      if (!unfinished_.insert(recording.file).second) continue;
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
  still_bytes_ = pinned_bytes_ = 0;
  for (const Recording& log : logs_) still_bytes_ += log.file == current_ ? 0 : log.bytes;
  for (const StoredEvent& event : index_.events()) {
    if (event.is_finished) (event.is_pinned ? pinned_bytes_ : still_bytes_) += event.bytes;
  }
  return {};
}

std::uint64_t RecordingFolder::limit() const {
  return static_cast<std::uint64_t>(settings_.limit_mib) * kMebibyte;
}

/// Limit of the recordings that are not pinned. A quarter is left to them, since new ones would
/// otherwise be deleted as soon as they are finished.
std::uint64_t RecordingFolder::room() const {
  return limit() - std::min(pinned_bytes_, limit() / 4 * 3);
}

/// Bytes of all recordings that are not pinned.
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

/// Recordings that may be deleted, in that order: those in the future, then the others, the oldest
/// first. The next day is not the future, since after a small step back of the clock the newest
/// recordings are in it.
std::vector<RecordingFolder::Deletable> RecordingFolder::deletable(
    std::chrono::system_clock::time_point utc) const {
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
  const std::string present = compact_utc_text(utc + std::chrono::days(1)).value_or("");
  std::ranges::sort(deletable, {}, [&](const Deletable& one) {
    return std::pair(one.begun <= present, std::string_view(one.begun));
  });
  return deletable;
}

/// Deletes an event. False: it was pinned since it was listed.
Result<bool> RecordingFolder::remove(const StoredEvent& listed) const {
  const auto event = events_.find(listed.name);
  if (!event) return true;  // another program was quicker
  if (event->is_pinned || !event->is_finished) return false;
  return events_.remove_unless_pinned(*event);
}

/// True: the recording was deleted. A failure is logged once and retried with the others, because a
/// disk may be read-only for a while.
bool RecordingFolder::is_removed(const std::string& name, const Result<bool>& done) {
  if (!done && undeletable_.insert(name).second) {
    log_line(LogLevel::Warning, "recorder: " + name + " cannot be deleted, others are instead: " +
                                    done.error().message);
  }
  return done.value_or(false);
}

/// Follows the difference of both clocks. True: it has been the same within a minute for an hour. A
/// clock without a battery may be years ahead until the network corrects it.
bool RecordingFolder::is_clock_settled(std::chrono::system_clock::time_point utc,
                                       hal::TimePoint now) {
  const std::chrono::nanoseconds offset = utc.time_since_epoch() - now.time_since_epoch();
  if (!clock_offset_ || std::chrono::abs(offset - *clock_offset_) > std::chrono::minutes(1)) {
    clock_offset_ = offset;
    settled_since_ = now;
  }
  return now - settled_since_ >= std::chrono::hours(1);
}

/// Deletes events whose trigger is too long ago. Before 1970, as without a battery for the clock,
/// none is.
int RecordingFolder::remove_old(std::chrono::system_clock::time_point utc) {
  constexpr int kMostAtOnce = 10;
  const std::chrono::days limit{settings_.events ? settings_.events->keep_days : 0};
  if (limit.count() == 0 || utc - limit <= Utc{}) return 0;
  const std::string oldest = event_name(utc - limit, TriggerKind::Alarm);
  int removed = 0;
  for (const StoredEvent& event : index_.events()) {
    if (event.name >= oldest || removed == kMostAtOnce) break;
    if (event.is_pinned || !event.is_finished) continue;
    removed += is_removed(event.name, remove(event)) ? 1 : 0;
  }
  return removed;
}

Result<int> RecordingFolder::make_room(const fs::path& current,
                                       std::chrono::system_clock::time_point utc,
                                       hal::TimePoint now) {
  const bool is_settled = is_clock_settled(utc, now);
  const auto old = update(current).map([&] { return is_settled ? remove_old(utc) : 0; });
  if (!old) return old;
  if (const auto updated = update(current); !updated) return tl::unexpected(updated.error());
  check_pins();
  return remove_for_room(utc).map([&](int removed) { return *old + removed; });
}

void RecordingFolder::check_pins() {
  const bool is_fault = pinned_bytes_ > limit() / 4 * 3;
  if (is_fault == !pin_fault_.empty()) return;
  if (!is_fault) {
    pin_fault_.clear();
    log_line(LogLevel::Info, "recorder: pinned events leave a quarter of limit_mib again");
    return;
  }
  pin_fault_ = settings_.folder.string() + ": pinned events take " + mebibytes(pinned_bytes_) +
               " of limit_mib = " + std::to_string(settings_.limit_mib) +
               "; at most three quarters are right, so unpin or delete some, or set a higher "
               "limit_mib; other recordings are deleted above a quarter of it";
  log_line(LogLevel::Warning, "recorder: " + pin_fault_);
}

Result<int> RecordingFolder::remove_for_room(std::chrono::system_clock::time_point utc) {
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
    if (left <= room() && !is_short) return removed;
    if (!all) all = deletable(utc);
    if (!is_short && oldest + 1 >= all->size()) return removed;  // the newest stays
    if (oldest == all->size()) {
      return fail(settings_.folder.string() + " has " + mebibytes(space.available) +
                  " left, less than reserve_mib, and no recording that can be deleted; pinned "
                  "events take " +
                  mebibytes(pinned_bytes_));
    }
    const Deletable& next = (*all)[oldest++];
    if (!is_removed(next.begun, next.remove())) continue;
    left -= next.bytes;
    ++removed;
  }
}

}  // namespace orbwatch::app::recorder
