// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/export_spool.h"

#include <algorithm>
#include <new>
#include <system_error>
#include <utility>

#include "app/log.h"
#include "app/ports/recorder/disk_space.h"
#include "app/ports/recorder/events/event_summary.h"

namespace orbwatch::app::recorder {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kSpoolMebibyte = std::uint64_t{1} << 20;

/// Name for people: that of the event, with the camera if the file has pictures of it alone. Names
/// of cameras are of any origin.
std::string file_name(const ExportRequest& request, const ExportKind& kind) {
  std::string camera = kind.has_camera ? request.camera : std::string();
  std::ranges::replace_if(
      camera,
      [](char c) {
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                              (c >= '0' && c <= '9') || c == '-' || c == '_';
        return !is_plain;
      },
      '_');
  return request.event + (camera.empty() ? "" : "-" + camera) + std::string(kind.ending);
}

Result<std::optional<RangeEnd>> range_end(const char* name, const std::string& text) {
  if (text.empty()) return std::optional<RangeEnd>();
  return parse_range_end(text)
      .map([](const RangeEnd& end) { return std::optional(end); })
      .map_error(
          [name](const Error& error) { return Error{std::string(name) + ": " + error.message}; });
}

}  // namespace

/// Space that an export may take.
class ExportSpool::Room {
 public:
  Room(const fs::path& folder, std::uint64_t reserve) : folder_(folder), reserve_(reserve) {}

  /// Error: there is none.
  Result<> measure() {
    std::error_code error;
    const std::uintmax_t free = fs::space(folder_, error).available;
    if (error) return fail(folder_.string() + ": " + error.message());
    limit_ = free > reserve_ ? (free - reserve_) / 2 : 0;
    if (limit_ >= kSpoolMebibyte) return {};
    return fail("no room: the disk has " + std::to_string(free / kSpoolMebibyte) +
                " MiB left, and reserve_mib is " + std::to_string(reserve_ / kSpoolMebibyte));
  }

  /// Bytes of the export so far. Error: it is too large. The disk is asked now and then.
  Result<std::uint64_t> use() {
    constexpr auto kPause = std::chrono::milliseconds(50);
    const hal::TimePoint now = hal::Clock::now();
    if (now < next_) return used_;
    next_ = now + kPause;
    used_ = bytes_in(folder_);
    std::error_code error;
    const std::uintmax_t free = fs::space(folder_, error).available;
    if (used_ <= limit_ && (error || free >= reserve_)) return used_;
    return fail("no room: the export is larger than " + std::to_string(limit_ / kSpoolMebibyte) +
                " MiB, half of the disk's free space above reserve_mib; choose a smaller range");
  }

 private:
  const fs::path folder_;
  const std::uint64_t reserve_;
  std::uint64_t limit_ = 0, used_ = 0;
  hal::TimePoint next_{};
};

ExportSpool::ExportSpool(const RecorderSettings& settings, ExportTimes times,
                         std::span<const ExportKind> kinds)
    : folder_(settings.folder / "exports"),
      reserve_(static_cast<std::uint64_t>(settings.reserve_mib) * kSpoolMebibyte),
      events_(settings.folder),
      times_(times),
      kinds_(kinds) {}

void ExportSpool::start() {
  if (thread_.is_running()) return;
  {
    const std::lock_guard lock(mutex_);
    is_started_ = true;
  }
  thread_.start("exports", hal::ThreadRole::Background, [this] { run(); });
}

void ExportSpool::stop() {
  {
    const std::lock_guard lock(mutex_);
    is_started_ = false;
  }
  thread_.stop();
  const std::lock_guard lock(mutex_);
  job_.reset();
  status_.state = ExportState::None;
}

void ExportSpool::run() {
  std::error_code none;
  fs::remove_all(folder_, none);  // of an earlier run
  while (thread_.wait_until(next_wake())) {
    remove_old();
    if (auto job = take_job()) make(std::move(*job));
  }
  fs::remove_all(folder_, none);
}

hal::TimePoint ExportSpool::next_wake() const {
  const std::lock_guard lock(mutex_);
  return status_.state == ExportState::Ready ? made_ + times_.kept
                                             : hal::Clock::now() + times_.kept;
}

void ExportSpool::remove_old() {
  {
    const std::lock_guard lock(mutex_);
    if (status_.state != ExportState::Ready || hal::Clock::now() < made_ + times_.kept) return;
    status_.state = ExportState::None;
  }
  std::error_code none;
  fs::remove_all(folder_, none);
}

/// Checks a request as far as that is quick.
Result<ExportSpool::Job> ExportSpool::job_of(const ExportRequest& request) const {
  const auto event = events_.find(request.event);
  if (!event) return tl::unexpected(event.error());
  if (const auto finished = EventFolder::check_finished(*event); !finished) {
    return tl::unexpected(finished.error());
  }
  const auto from = range_end("from", request.from);
  if (!from) return tl::unexpected(from.error());
  const auto to = range_end("to", request.to);
  if (!to) return tl::unexpected(to.error());
  const auto kind = std::ranges::find(kinds_, request.format, &ExportKind::format);
  if (request.draws && !kind->has_text) return fail("draws: values are drawn into avi only");
  const auto text = request.draws ? VideoText::Values : VideoText::None;
  return Job{0,
             *kind,
             {event->folder / kEventFile, {}, kind->has_camera ? request.camera : "", text},
             {*from, *to}};
}

/// Error: another export is in the way. Under the lock.
Result<> ExportSpool::check_free(const ExportRequest& request) const {
  const std::string whose =
      status_.user.empty() ? "another export" : "an export of " + status_.user;
  if (status_.state == ExportState::Making) {
    return fail(whose + " is being made; wait for it, or cancel it");
  }
  const bool is_owned = status_.state == ExportState::Ready && status_.user != request.user &&
                        hal::Clock::now() < made_ + times_.owned;
  if (is_owned) return fail(whose + " waits for its download; try again in a minute");
  return {};
}

Result<std::uint64_t> ExportSpool::begin(const ExportRequest& request) {
  auto job = job_of(request);
  if (!job) return tl::unexpected(job.error());
  const std::lock_guard lock(mutex_);
  if (!is_started_) return fail("no exports are made: the appliance is stopping");
  if (const auto free = check_free(request); !free) return tl::unexpected(free.error());
  job->number = status_.number + 1;
  status_ = {job->number,
             ExportState::Making,
             request.event,
             request.user,
             file_name(request, job->kind),
             0,
             0,
             {},
             0,
             {}};
  job_ = std::move(*job);
  is_cancelled_ = false;
  thread_.wake();
  return status_.number;
}

std::optional<ExportSpool::Job> ExportSpool::take_job() {
  const std::lock_guard lock(mutex_);
  return std::exchange(job_, std::nullopt);
}

bool ExportSpool::is_wanted() const {
  const std::lock_guard lock(mutex_);
  return !is_cancelled_ && !thread_.stop_requested();
}

/// Nothing of an export that fails or is cancelled remains, and nothing of the one before.
void ExportSpool::make(Job job) {
  std::error_code none;
  fs::remove_all(folder_, none);
  const auto written = is_wanted() ? write(job) : cancelled_export();
  const std::uintmax_t bytes = written ? fs::file_size(path_of(job.number), none) : 0;
  if (!end(written, bytes)) fs::remove_all(folder_, none);
}

/// True: the file is ready.
bool ExportSpool::end(const Result<>& written, std::uint64_t bytes) {
  std::string failure;
  {
    const std::lock_guard lock(mutex_);
    made_ = hal::Clock::now();
    status_.bytes = bytes;
    status_.state = is_cancelled_ ? ExportState::None
                    : written     ? ExportState::Ready
                                  : ExportState::Failed;
    if (status_.state == ExportState::Ready) return true;
    if (status_.state == ExportState::None) return false;
    status_.error = written.error().message;
    failure = "recorder: " + status_.event + " is not exported: " + status_.error;
  }
  log_line(LogLevel::Warning, failure);
  return false;
}

/// A recording of any origin may need more memory than there is, which must not end the daemon.
Result<> ExportSpool::write(Job& job) try {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) return fail(folder_.string() + ": " + error.message());
  Room room(folder_, reserve_);
  if (auto measured = room.measure(); !measured) return measured;
  const auto range = stamps_in(job.source.recording, job.range);
  if (!range) return tl::unexpected(range.error());
  job.source.range = *range;
  std::string problem;
  const auto steps = [&](std::size_t done, std::size_t of, const char* unit) {
    const auto used = room.use();
    if (!used) problem = used.error().message;
    const std::lock_guard lock(mutex_);
    status_.done = done;
    status_.of = of;
    status_.unit = unit;
    status_.bytes = used.value_or(0);
    return used && !is_cancelled_ && !thread_.stop_requested();
  };
  auto written = job.kind.write(job.source, path_of(job.number), steps);
  if (!problem.empty()) return fail(problem);
  return written;
} catch (const std::bad_alloc&) {
  return fail("not enough memory; export a smaller range");
}

ExportStatus ExportSpool::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

fs::path ExportSpool::path_of(std::uint64_t number) const {
  return folder_ / std::to_string(number);
}

Result<fs::path> ExportSpool::file(std::uint64_t number) const {
  const std::lock_guard lock(mutex_);
  if (number == status_.number && status_.state == ExportState::Ready) return path_of(number);
  return fail("there is no file of export " + std::to_string(number) +
              "; it was downloaded, removed or is not finished");
}

Result<> ExportSpool::remove(std::uint64_t number) {
  {
    const std::lock_guard lock(mutex_);
    const bool is_making = status_.state == ExportState::Making;
    if (number != status_.number || (!is_making && status_.state != ExportState::Ready)) {
      return fail("export " + std::to_string(number) + " has ended");
    }
    is_cancelled_ = true;
    if (is_making) return {};
    status_.state = ExportState::None;
  }
  std::error_code none;
  fs::remove(path_of(number), none);
  return {};
}

}  // namespace orbwatch::app::recorder

namespace orbwatch::app {

std::shared_ptr<RecordedExports> recorded_exports(const RecorderSettings& settings) {
  if (settings.folder.empty() || !settings.events) return nullptr;
  return std::make_shared<recorder::ExportSpool>(settings);
}

}  // namespace orbwatch::app
