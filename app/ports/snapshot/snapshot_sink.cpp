// SPDX-License-Identifier: Apache-2.0
#include "app/ports/snapshot/snapshot_sink.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "app/log.h"
#include "app/model/status/utc_text.h"
#include "app/pictures/picture_file.h"
#include "hal/atomic_file.h"

namespace orbwatch::app {
namespace {

namespace fs = std::filesystem;

/// Name of a snapshot: VIEW_TIME_FRAMESET.
std::string name_of(const View& view) {
  return std::string(view.name) + "_" + compact_utc_text(hal::to_utc(view.stamp)).value_or("") +
         "_" + std::to_string(view.frame_set);
}

constexpr std::string_view kDigits = "0123456789";
constexpr std::string_view kWord =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";

bool remove_end(std::string_view& text, std::string_view end) {
  if (!text.ends_with(end)) return false;
  text.remove_suffix(end.size());
  return true;
}

/// The common part of the names of a snapshot's files that this sink writes:
/// VIEW_STAMP_NUMBER[_measured].png; nullopt for other files.
std::optional<std::string> snapshot_of(const fs::path& file) {
  const std::string file_name = file.filename().string();
  std::string_view name = file_name;
  if (!remove_end(name, ".png")) return std::nullopt;
  remove_end(name, "_measured");
  const std::size_t number = name.find_last_not_of(kDigits) + 1;
  std::string_view view = name.substr(0, number);
  if (number == name.size() || !remove_end(view, "_") || view.size() < kCompactUtcLength)
    return std::nullopt;
  const std::string_view stamp = view.substr(view.size() - kCompactUtcLength);
  view.remove_suffix(kCompactUtcLength);
  const bool is_ours = is_compact_utc_text(stamp) && remove_end(view, "_") && !view.empty() &&
                       view.find_first_not_of(kWord) == view.npos;
  if (!is_ours) return std::nullopt;
  return std::string(name);
}

/// A snapshot in the folder.
struct Snapshot {
  fs::file_time_type written{};  ///< modification time of its newest file
  std::vector<fs::path> files{};
};
/// Snapshots by the common part of their files' names.
using Snapshots = std::map<std::string, Snapshot>;

Snapshots snapshots_in(const fs::path& folder, std::error_code& error) {
  Snapshots found;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const auto name = snapshot_of(it->path());
    if (!name) continue;
    std::error_code gone;  // set if the file was removed meanwhile
    const auto written = it->last_write_time(gone);
    if (gone) continue;
    Snapshot& snapshot = found[*name];
    snapshot.written = std::max(snapshot.written, written);
    snapshot.files.push_back(it->path());
  }
  return found;
}

/// Gives `newest` the latest modification time, regardless of the clock when others were written,
/// so that the order by modification time survives the process.
void order_last(Snapshot& newest, fs::file_time_type others, std::error_code& error) {
  // FAT has a resolution of two seconds.
  for (const auto step : {std::chrono::milliseconds(1), std::chrono::milliseconds(2000)}) {
    if (error || newest.written > others || newest.files.empty()) return;
    fs::last_write_time(newest.files.front(), others + step, error);
    if (!error) newest.written = fs::last_write_time(newest.files.front(), error);
  }
}

}  // namespace

SnapshotSink::~SnapshotSink() { stop(); }

CommandResult SnapshotSink::request(std::size_t view) {
  if (view >= kMaxViews) return CommandResult::ArgumentOutOfRange;
  if (!live_[view]) return CommandResult::NotPossible;
  if (busy_[view].exchange(true)) return CommandResult::Busy;
  wanted_[view] = true;
  return CommandResult::Done;
}

Result<> SnapshotSink::start() {
  std::error_code error;
  std::filesystem::create_directories(settings_.folder, error);
  if (!error && ::access(settings_.folder.c_str(), W_OK) != 0)
    error.assign(errno, std::generic_category());
  if (error) {
    return fail("snapshot.folder: " + settings_.folder.string() + ": " + error.message() +
                "; it must be a writable folder");
  }
  if (auto removed = hal::remove_unfinished(settings_.folder); !removed) {
    return fail("snapshot.folder: " + removed.error().message);
  }
  thread_.start("snapshot", hal::ThreadRole::Background, [this] {
    while (thread_.wait()) write_all();
    write_all();  // views accepted before the stop
  });
  return {};
}

void SnapshotSink::accept(const Status& status) {
  for (std::size_t i = 0; i < status.view_count; ++i) {
    live_[i] = status.views[i].live;
    if (live_[i] || !wanted_[i].exchange(false)) continue;
    busy_[i] = false;
    log_soon(LogLevel::Warning, {"snapshot: request dropped: view ", std::to_string(i),
                                 " no longer has a recipe or a camera"});
  }
}

PictureNeeds SnapshotSink::needs(std::size_t view, hal::TimePoint /*stamp*/) {
  asked_[view] = wanted_[view];
  return asked_[view] ? need_of(PixelFormat::Rgb) : PictureNeeds{};
}

void SnapshotSink::accept(const ViewPtr& view) {
  if (!asked_[view->index] || !wanted_[view->index].exchange(false)) return;
  accepted_.put(view);
  thread_.wake();
}

void SnapshotSink::write_all() {
  while (auto view = accepted_.try_take()) {
    const std::size_t index = (*view)->index;
    const std::string name = name_of(**view);
    const auto written = write(**view, name);
    view.reset();
    const auto done = written.and_then([&] { return remove_oldest(name); });
    if (!done) log_line(LogLevel::Error, "snapshot: " + done.error().message);
    busy_[index] = false;
    if (done) ++written_;
  }
}

Result<> SnapshotSink::write(const View& view, const std::string& name) {
  const auto path = settings_.folder / (name + ".png");
  if (auto done = write_picture(path, view.picture); !done) {
    return done;
  }
  const auto measured = settings_.folder / (name + "_measured.png");
  if (!view.radiometric.empty()) {
    return write_picture(measured, picture_of(PixelFormat::Y16, view.radiometric));
  }
  if (!view.luminance.empty()) {
    return write_picture(measured, picture_of(PixelFormat::Grey, view.luminance));
  }
  return {};
}

/// Removes the oldest snapshots; `newest` counts as written last, even if the clock was set back.
Result<> SnapshotSink::remove_oldest(const std::string& newest) {
  std::error_code error;
  Snapshots snapshots = snapshots_in(settings_.folder, error);
  Snapshot last = std::exchange(snapshots[newest], {});
  snapshots.erase(newest);
  std::vector<std::pair<fs::file_time_type, std::string>> order;
  order.reserve(snapshots.size());
  for (const auto& [name, snapshot] : snapshots) order.emplace_back(snapshot.written, name);
  std::ranges::sort(order);
  if (!order.empty()) order_last(last, order.back().first, error);
  const auto keep = static_cast<std::size_t>(settings_.keep) - 1;
  for (std::size_t i = 0; i + keep < order.size(); ++i) {
    for (const fs::path& file : snapshots[order[i].second].files) {
      if (!error) fs::remove(file, error);
    }
  }
  if (error) return fail(settings_.folder.string() + ": " + error.message());
  return {};
}

std::unique_ptr<Sink> make_sink(const SnapshotSettings& settings) {
  if (settings.folder.empty()) return nullptr;
  return std::make_unique<SnapshotSink>(settings);
}

}  // namespace orbwatch::app
