// SPDX-License-Identifier: Apache-2.0
#include "app/log_writer.h"

#include <algorithm>
#include <atomic>
#include <string>
#include <utility>

namespace orbwatch::app {
namespace {

std::atomic<LogWriter*> living{nullptr};

}  // namespace

template <std::size_t kMost>
void LogWriter::Text<kMost>::append(std::string_view part) {
  const std::size_t fitting = std::min(part.size(), kMost - size_);
  std::copy_n(part.begin(), fitting, bytes_.begin() + static_cast<std::ptrdiff_t>(size_));
  size_ += fitting;
}

LogWriter::LogWriter(Output output) : output_(std::move(output)) {
  thread_.start("log", [this] {
    while (thread_.wait()) write_waiting();
  });
  living = this;
}

LogWriter::~LogWriter() {
  living = nullptr;
  thread_.stop();
  write_waiting();
}

LogWriter* LogWriter::current() { return living; }

void LogWriter::write(const LogRecord& record) {
  std::unique_lock lock(queue_);
  if (count_ == kMaxWaiting && !is_stalled_) {
    is_stalled_ = !progress_.wait_for(lock, kLongestWait, [this] { return count_ < kMaxWaiting; });
  }
  Waiting* const line = add(record.level, {record.text}, record.fields);
  if (line == nullptr) return;
  if (record.text.size() > kMaxText) line->rest = record.text.substr(kMaxText);
  const std::uint64_t number = added_;
  thread_.wake();
  if (is_stalled_) return;
  is_stalled_ =
      !progress_.wait_for(lock, kLongestWait, [this, number] { return written_ >= number; });
}

bool LogWriter::flush(std::chrono::milliseconds patience) {
  std::unique_lock lock(queue_);
  return progress_.wait_for(lock, patience,
                            [this] { return count_ == 0 && dropped_ == 0 && !is_writing_; });
}

void LogWriter::write_soon(LogLevel level, std::initializer_list<std::string_view> text,
                           const LogFields& fields) {
  {
    const std::lock_guard lock(queue_);
    if (add(level, text, fields) == nullptr) return;
  }
  thread_.wake();
}

/// Adds a line; call with queue_ held. Null: the queue is full, and the line is dropped.
LogWriter::Waiting* LogWriter::add(LogLevel level, std::initializer_list<std::string_view> text,
                                   const LogFields& fields) {
  if (count_ == kMaxWaiting) {
    ++dropped_;
    return nullptr;
  }
  Waiting& line = waiting_[(oldest_ + count_) % kMaxWaiting];
  ++count_;
  ++added_;
  line = {.level = level, .trigger = fields.trigger};
  for (const std::string_view part : text) line.text.append(part);
  line.camera.append(fields.camera);
  line.fault.append(fields.fault);
  return &line;
}

void LogWriter::write_waiting() {
  while (write_next()) {
  }
}

/// Writes the oldest line, or, without one, the number of dropped lines. False: there is nothing to
/// write.
bool LogWriter::write_next() {
  Waiting line;
  std::uint64_t dropped = 0;
  {
    const std::lock_guard lock(queue_);
    if (count_ > 0) {
      line = std::exchange(waiting_[oldest_], {});
      oldest_ = (oldest_ + 1) % kMaxWaiting;
      --count_;
    } else {
      dropped = std::exchange(dropped_, 0);
      if (dropped == 0) return false;
    }
    is_writing_ = true;
  }
  if (dropped > 0) {
    output_({LogLevel::Warning,
             std::to_string(dropped) + " lines were dropped: the log was not read in time",
             {}});
  } else {
    const std::string whole = line.rest.empty() ? "" : std::string(line.text.view()) + line.rest;
    output_({line.level,
             whole.empty() ? line.text.view() : whole,
             {line.camera.view(), line.fault.view(), line.trigger}});
  }
  {
    const std::lock_guard lock(queue_);
    is_writing_ = false;
    is_stalled_ = false;
    written_ += dropped == 0 ? 1 : 0;
  }
  progress_.notify_all();
  return true;
}

}  // namespace orbwatch::app
