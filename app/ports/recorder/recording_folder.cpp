// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/recording_folder.h"

#include <algorithm>
#include <ctime>
#include <string>
#include <string_view>
#include <system_error>

#include "app/log.h"
#include "app/ports/recorder/disk_space.h"
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

Result<RecordingFolder::Contents> RecordingFolder::contents(const fs::path& current) const {
  const auto logs = list();
  if (!logs) return tl::unexpected(logs.error());
  const auto events = events_.list();
  if (!events) return tl::unexpected(events.error());
  Contents contents;
  for (const Recording& log : *logs) {
    contents.bytes += log.bytes;
    if (log.file == current) continue;
    const auto remove = [file = log.file]() -> Result<> {
      std::error_code error;
      if (!fs::remove(file, error) && error) return fail(text_of(file, error));
      return {};
    };
    const std::string name = log.file.filename().string().substr(kLogName.size());
    contents.deletable.push_back({name, log.bytes, remove});
  }
  for (const StoredEvent& event : *events) {
    contents.bytes += event.bytes;
    if (event.is_pinned || !event.is_finished) continue;
    const auto remove = [this, event] { return events_.remove(event); };
    contents.deletable.push_back({event.name, event.bytes, remove});
  }
  std::ranges::sort(contents.deletable, {}, &Deletable::begun);
  return contents;
}

Result<int> RecordingFolder::make_room(const fs::path& current) const {
  auto found = contents(current);
  if (!found) return tl::unexpected(found.error());
  const auto limit = static_cast<std::uint64_t>(settings_.limit_mib) * kMebibyte;
  const auto reserve = static_cast<std::uint64_t>(settings_.reserve_mib) * kMebibyte;
  int removed = 0;
  for (auto oldest = found->deletable.begin();; ++oldest) {
    std::error_code error;
    const fs::space_info space = fs::space(settings_.folder, error);
    if (error) return fail(text_of(settings_.folder, error));
    const bool is_short = space.available < reserve;
    if (found->bytes <= limit && !is_short) return removed;
    if (oldest == found->deletable.end()) {
      if (!is_short) return removed;
      return fail(settings_.folder.string() + " has " +
                  std::to_string(space.available / kMebibyte) +
                  " MiB left, less than reserve_mib, and no recording to delete");
    }
    if (auto done = oldest->remove(); !done) return tl::unexpected(done.error());
    found->bytes -= oldest->bytes;
    ++removed;
  }
}

}  // namespace orbwatch::app::recorder
