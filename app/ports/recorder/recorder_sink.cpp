// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/recorder_sink.h"

#include <cerrno>
#include <utility>

#include "app/log.h"

namespace orbwatch::app {
namespace {

using hal::mcap::FileResult;
using recorder::Utc;

constexpr std::chrono::seconds kFlushPeriod{1};
constexpr std::chrono::hours kFileTime{1};
constexpr std::chrono::seconds kLongestSilence{10};

}  // namespace

RecorderSink::RecorderSink(RecorderSettings settings, StatusNames names, RecordedTexts texts)
    : settings_(std::move(settings)),
      names_(std::move(names)),
      texts_(std::move(texts)),
      folder_(settings_) {}

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

void RecorderSink::accept(const Status& status) {
  if (status.frame_set == last_set_) return;
  last_set_ = status.frame_set;
  states_.put({status, hal::to_utc(status.stamp)});
  thread_.wake();
}

void RecorderSink::accept_event(const AlarmNotice& notice) {
  events_.put({notice, hal::to_utc(notice.stamp)});
  thread_.wake();
}

void RecorderSink::run() {
  while (thread_.wait_until(next_wake())) record_all();
  record_all();
  end();
}

/// End of the recorder's pause: nothing is due while it has no file.
hal::TimePoint RecorderSink::next_wake() const {
  return file_ ? next_flush_ : hal::Clock::now() + kFlushPeriod;
}

void RecorderSink::record_all() {
  const hal::TimePoint now = hal::Clock::now();
  busy_since_ = now;
  if (!file_ && now >= next_try_) {
    if (const auto begun = begin(); !begun) give_up(begun.error().message);
  }
  const bool is_due = file_ && now >= next_flush_;
  auto done = record();
  if (done && is_due) done = flush(now);
  if (!done) give_up(done.error().message);
  if (file_ && now >= next_file_) end();
  busy_since_ = hal::TimePoint{};
}

/// Writes what waits; without a file it is lost.
FileResult<> RecorderSink::record() {
  while (const auto event = events_.try_take()) {
    if (!file_) {
      ++counters_.lost;
      continue;
    }
    ++unflushed_events_;
    auto written = file_->write_event(event->notice, names_, event->stamp);
    if (!written) return written;
  }
  while (const auto state = states_.try_take()) {
    if (!file_) {
      ++counters_.lost;
      continue;
    }
    // Ages count until the exposure, so that they do not depend on when this is written.
    const StatusReport report{state->status, names_, state->status.stamp, state->stamp};
    ++unflushed_states_;
    auto written = file_->write_state(report);
    if (!written) return written;
  }
  return {};
}

Result<> RecorderSink::begin() {
  if (!is_prepared_) {
    if (auto prepared = folder_.prepare(); !prepared) return prepared;
    is_prepared_ = true;
  }
  const Utc utc = std::chrono::system_clock::now();
  const std::filesystem::path path = folder_.name_for(utc);
  const auto removed = folder_.make_room(path);
  if (!removed) return tl::unexpected(removed.error());
  counters_.removed += static_cast<std::uint64_t>(*removed);
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

FileResult<> RecorderSink::flush(hal::TimePoint now) {
  next_flush_ = now + kFlushPeriod;
  auto flushed = file_->flush();
  counters_.bytes += file_->size() - std::exchange(known_size_, file_->size());
  if (!flushed) return flushed;
  count_flushed();
  const auto removed = folder_.make_room(file_->path());
  if (!removed) return tl::unexpected(hal::mcap::FileError{ENOSPC, removed.error().message});
  counters_.removed += static_cast<std::uint64_t>(*removed);
  return {};
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
  statistics.fault = !works();
  const std::chrono::duration<double, std::ratio<86400>> days = hal::Clock::now() - started_;
  statistics.per_day = static_cast<double>(statistics.bytes) / (1 << 20) / days.count();
  return statistics;
}

std::vector<InterfaceMetric> RecorderSink::metrics() const {
  std::vector<InterfaceMetric> all;
  add_metrics(all, {"recorder"}, statistics(), {});
  return all;
}

std::unique_ptr<Sink> make_sink(const RecorderSettings& settings, const StatusNames& names,
                                const RecordedTexts& texts) {
  if (settings.folder.empty()) return nullptr;
  return std::make_unique<RecorderSink>(settings, names, texts);
}

}  // namespace orbwatch::app
