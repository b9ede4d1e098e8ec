// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/recorder_sink.h"

#include <utility>

#include "app/log.h"
#include "app/ports/recorder/events/event_archive.h"
#include "app/ports/recorder/events/ring_size.h"

namespace orbwatch::app {
namespace {

using recorder::Utc;

constexpr std::chrono::seconds kFlushPeriod{1};
constexpr std::chrono::hours kFileTime{1};
constexpr std::chrono::seconds kLongestSilence{10};

}  // namespace

RecorderSink::RecorderSink(RecorderSettings settings, StatusNames names, RecordedTexts texts,
                           std::vector<RecordedCamera> cameras)
    : settings_(std::move(settings)),
      names_(std::move(names)),
      texts_(std::move(texts)),
      folder_(settings_) {
  if (!settings_.events) return;
  if (const auto fits = recorder::check_ring(*settings_.events, cameras); !fits) {
    log_line(LogLevel::Warning, "recorder: events may lack pictures: " + fits.error().message);
  }
  pictures_.emplace(settings_, std::move(cameras), names_, texts_, counters_);
}

Result<> RecorderSink::start() {
  if (thread_.is_running()) return {};
  started_ = hal::Clock::now();
  thread_.start("recorder", hal::ThreadRole::Background, [this] { run(); });
  return {};
}

bool RecorderSink::works() const {
  const hal::TimePoint busy_since = busy_since_;
  const bool is_silent =
      busy_since != hal::TimePoint{} && hal::Clock::now() - busy_since > kLongestSilence;
  return !has_fault_ && !is_silent;
}

void RecorderSink::accept_format(std::size_t camera, const hal::StreamFormat& format) {
  if (pictures_) pictures_->accept_format(camera, format);
}

void RecorderSink::accept_frames(const hal::FrameSet& set) {
  if (pictures_) pictures_->accept_frames(set);
}

void RecorderSink::accept(const Status& status) {
  if (pictures_) pictures_->accept(status);
  if (status.frame_set != last_set_) {
    last_set_ = status.frame_set;
    states_.put({status, hal::to_utc(status.stamp)});
  }
  thread_.wake();
}

void RecorderSink::accept_event(const AlarmNotice& notice) {
  if (pictures_) pictures_->accept_event(notice);
  events_.put({notice, hal::to_utc(notice.stamp)});
  thread_.wake();
}

bool RecorderSink::request_event() {
  if (pictures_) pictures_->request();
  return pictures_.has_value();
}

void RecorderSink::run() {
  while (thread_.wait_until(next_wake())) record_all();
  if (pictures_) pictures_->fire_waiting();
  record_all();
  if (pictures_) {
    if (const auto ended = pictures_->end(); !ended) give_up(ended.error().message);
  }
  end();
}

/// End of the recorder's pause: nothing is due while it has no file.
hal::TimePoint RecorderSink::next_wake() const {
  return file_ ? next_flush_ : hal::Clock::now() + kFlushPeriod;
}

void RecorderSink::record_all() {
  bool is_more = true;
  while (is_more) {
    const hal::TimePoint now = hal::Clock::now();
    busy_since_ = now;
    if (!file_ && now >= next_try_) {
      if (const auto begun = begin(); !begun) give_up(begun.error().message);
    }
    const auto recorded = record_round(now);
    if (!recorded) give_up(recorded.error().message);
    is_more = recorded.value_or(false);
    if (file_ && now >= next_file_) end();
  }
  busy_since_ = hal::TimePoint{};
}

/// Writes what waits, of pictures one for each event. True: more of them wait. Without a disk they
/// are lost.
Result<bool> RecorderSink::record_round(hal::TimePoint now) {
  if (!file_ && pictures_) pictures_->give_up();
  Result<> done = file_ && pictures_ ? pictures_->begin_round() : Result<>();
  done = done.and_then([this] { return record(); });
  Result<bool> is_more = done.map([] { return false; });
  if (done && file_ && pictures_) is_more = pictures_->end_round();
  if (!is_more || !file_ || now < next_flush_) return is_more;
  return flush(now).map([&] { return *is_more; });
}

/// Writes the events and states that wait.
Result<> RecorderSink::record() {
  while (const auto event = events_.try_take()) {
    auto kept =
        keep(recorder::event_message(event->notice, names_, event->stamp), unflushed_events_);
    if (!kept) return kept;
  }
  while (const auto state = states_.try_take()) {
    // Ages count until the exposure, so that they do not depend on when this is written.
    const StatusReport report{state->status, names_, state->status.stamp, state->stamp};
    if (auto kept = keep(recorder::state_message(report), unflushed_states_); !kept) return kept;
  }
  return {};
}

/// Writes a message into the log, without which it is lost there, and into the events.
Result<> RecorderSink::keep(recorder::LogMessage message, std::uint64_t& unflushed) {
  if (file_) {
    ++unflushed;
    if (auto written = file_->write(message); !written) return fail(written.error().message);
  } else {
    ++counters_.lost;
  }
  return pictures_ ? pictures_->keep(std::move(message)) : Result<>();
}

Result<> RecorderSink::begin() {
  if (!is_prepared_) {
    if (auto prepared = folder_.prepare(); !prepared) return prepared;
    is_prepared_ = true;
  }
  const Utc utc = std::chrono::system_clock::now();
  const std::filesystem::path path = folder_.name_for(utc);
  if (auto made = make_room(path, utc); !made) return made;
  auto file = recorder::LogFile::create(path, texts_, utc);
  if (!file) return fail(file.error().message);
  file_.emplace(std::move(*file));
  known_size_ = 0;
  next_flush_ = hal::Clock::now() + kFlushPeriod;
  next_file_ = hal::Clock::now() + kFileTime;
  back_off_.reset();
  has_fault_ = false;
  if (!std::exchange(fault_, {}).empty()) {
    log_line(LogLevel::Info, "recorder: records again, into " + path.string());
  }
  return {};
}

Result<> RecorderSink::flush(hal::TimePoint now) {
  next_flush_ = now + kFlushPeriod;
  auto flushed = file_->flush();
  counters_.bytes += file_->size() - std::exchange(known_size_, file_->size());
  if (!flushed) return fail(flushed.error().message);
  count_flushed();
  if (auto written = pictures_ ? pictures_->flush() : Result<>(); !written) return written;
  return make_room(file_->path(), std::chrono::system_clock::now());
}

Result<> RecorderSink::make_room(const std::filesystem::path& log, Utc utc) {
  return folder_.make_room(log, utc).map([this](int removed) {
    counters_.removed += static_cast<std::uint64_t>(removed);
    has_pin_fault_ = !folder_.pin_fault().empty();
  });
}

void RecorderSink::end() {
  if (!file_) return;
  const auto finished = file_->finish();
  counters_.bytes += file_->size() - std::exchange(known_size_, file_->size());
  file_.reset();
  if (!finished) return give_up(finished.error().message);
  count_flushed();
}

void RecorderSink::count_flushed() {
  counters_.recorded += std::exchange(unflushed_states_, 0);
  counters_.events += std::exchange(unflushed_events_, 0);
}

/// Messages that were not flushed are lost. The file stays as it is; preparing the folder finishes
/// it.
void RecorderSink::give_up(const std::string& reason) {
  file_.reset();
  if (pictures_) pictures_->give_up();
  counters_.lost += std::exchange(unflushed_states_, 0) + std::exchange(unflushed_events_, 0);
  is_prepared_ = false;
  has_fault_ = true;
  next_try_ = hal::Clock::now() + back_off_.next();
  if (reason == fault_) return;
  fault_ = reason;
  log_line(LogLevel::Warning, "recorder: does not record: " + reason);
}

recorder::RecorderStatistics RecorderSink::statistics() const {
  recorder::RecorderStatistics statistics = counters_.read();
  statistics.lost += states_.drops() + events_.drops();
  if (pictures_) pictures_->add_figures(statistics);
  statistics.fault = !works() || has_pin_fault_;
  const std::chrono::duration<double, std::ratio<86400>> days = hal::Clock::now() - started_;
  statistics.per_day = static_cast<double>(statistics.bytes) / (1 << 20) / days.count();
  return statistics;
}

std::vector<InterfaceMetric> RecorderSink::metrics() const {
  std::vector<InterfaceMetric> all;
  add_metrics(all, {"recorder"}, statistics(), {});
  return all;
}

Result<> check_recorded(const RecorderSettings& settings,
                        const std::vector<RecordedCamera>& cameras) {
  return settings.events ? recorder::check_ring(*settings.events, cameras) : Result<>();
}

bool records_pictures(const RecorderSettings& settings, std::string_view camera) {
  return !settings.folder.empty() && settings.events &&
         recorder::is_recorded(*settings.events, camera);
}

std::shared_ptr<RecordedEvents> recorded_events(const RecorderSettings& settings) {
  if (settings.folder.empty() || !settings.events) return nullptr;
  return std::make_shared<recorder::EventArchive>(settings.folder);
}

std::unique_ptr<Sink> make_sink(const RecorderSettings& settings, const StatusNames& names,
                                const RecordedTexts& texts,
                                const std::vector<RecordedCamera>& cameras) {
  if (settings.folder.empty()) return nullptr;
  return std::make_unique<RecorderSink>(settings, names, texts, cameras);
}

}  // namespace orbwatch::app
