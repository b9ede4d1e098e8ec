#include "app/snapshot/snapshot_sink.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "app/log.h"
#include "app/pictures/picture_file.h"

namespace orbwatch::app {
namespace {

/// 20260131T235959.123Z: sorts by time.
std::string stamp_text(hal::TimePoint moment) {
  using std::chrono::milliseconds;
  const auto utc = std::chrono::floor<milliseconds>(hal::to_utc(moment)).time_since_epoch();
  const std::time_t seconds = std::chrono::floor<std::chrono::seconds>(utc).count();
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y%m%dT%H%M%S", &parts);
  const std::string fraction = std::to_string(1000 + utc.count() % 1000).substr(1);
  return std::string(text.data()) + "." + fraction + "Z";
}

/// VIEW_TIME_FRAMESET
std::string name_of(const View& view) {
  return std::string(view.name) + "_" + stamp_text(view.stamp) + "_" +
         std::to_string(view.frame_set);
}

/// A snapshot in the folder, by its time and its name without what tells its files apart.
struct Snapshot {
  std::string stamp;
  std::string name;
  bool operator<(const Snapshot& other) const {
    return std::tie(stamp, name) < std::tie(other.stamp, other.name);
  }
};

/// What a file written here belongs to; nothing for other files.
std::optional<Snapshot> snapshot_of(const std::filesystem::path& file) {
  static const std::regex kName(R"((\w+_(\d{8}T\d{6}\.\d{3}Z)_\d+)(_measured)?\.png)");
  std::smatch match;
  const std::string name = file.filename().string();
  if (!std::regex_match(name, match, kName)) return std::nullopt;
  return Snapshot{match[2].str(), match[1].str()};
}

}  // namespace

SnapshotSink::~SnapshotSink() { stop(); }

CommandResult SnapshotSink::command(const Command& command) {
  if (command.code != CommandCode::Snapshot) return CommandResult::UnknownCommand;
  const std::size_t view = whole(command, 0);
  if (view >= kMaxViews) return CommandResult::ArgumentOutOfRange;
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
                "; it must be a folder that can be written to");
  }
  thread_ = std::thread([this] { run(); });
  return {};
}

void SnapshotSink::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  work_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void SnapshotSink::accept(const ViewPtr& view) {
  if (!wanted_[view->index].exchange(false)) return;
  {
    const std::lock_guard lock(mutex_);
    taken_[view->index] = view;
  }
  work_.notify_one();
}

void SnapshotSink::run() {
  while (const ViewPtr view = take()) {
    const std::string name = name_of(*view);
    const auto done = write(*view, name).and_then([&] { return remove_oldest(name); });
    if (!done) log_line(LogLevel::Error, "snapshot: " + done.error().message);
    busy_[view->index] = false;
    if (done) ++written_;
  }
}

/// The next one to write; null: there will be none.
ViewPtr SnapshotSink::take() {
  std::unique_lock lock(mutex_);
  const auto next = [this] {
    return std::ranges::find_if(taken_, [](const ViewPtr& view) { return view != nullptr; });
  };
  work_.wait(lock, [&] { return stopping_ || next() != taken_.end(); });
  return next() == taken_.end() ? nullptr : std::exchange(*next(), nullptr);
}

Result<> SnapshotSink::write(const View& view, const std::string& name) {
  const auto path = settings_.folder / (name + ".png");
  if (auto done = write_picture(path, picture_of(PixelFormat::Rgb, view.colour)); !done) {
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

/// `newest` stays, also when the clock was put back and its name is not the last.
Result<> SnapshotSink::remove_oldest(const std::string& newest) {
  std::map<Snapshot, std::vector<std::filesystem::path>> others;
  std::error_code error;
  for (std::filesystem::directory_iterator it(settings_.folder, error), end; !error && it != end;
       it.increment(error)) {
    const auto snapshot = snapshot_of(it->path());
    if (snapshot && snapshot->name != newest) others[*snapshot].push_back(it->path());
  }
  const auto keep = static_cast<std::size_t>(settings_.keep) - 1;
  for (auto oldest = others.begin(); !error && others.size() > keep; others.erase(oldest++)) {
    for (const auto& file : oldest->second) {
      if (!error) std::filesystem::remove(file, error);
    }
  }
  if (error) return fail(settings_.folder.string() + ": " + error.message());
  return {};
}

}  // namespace orbwatch::app
