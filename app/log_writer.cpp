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
    while (thread_.wait()) flush();
  });
  living = this;
}

LogWriter::~LogWriter() {
  living = nullptr;
  thread_.stop();
  flush();
}

LogWriter* LogWriter::current() { return living; }

void LogWriter::write(const LogRecord& record) {
  const std::lock_guard lock(writing_);
  write_waiting();
  output_(record);
}

void LogWriter::flush() {
  const std::lock_guard lock(writing_);
  write_waiting();
}

void LogWriter::write_soon(LogLevel level, std::initializer_list<std::string_view> text,
                           const LogFields& fields) {
  {
    const std::lock_guard lock(queue_);
    if (count_ == kMaxWaiting) {
      ++dropped_;
      return;
    }
    Waiting& line = waiting_[(oldest_ + count_) % kMaxWaiting];
    ++count_;
    line = {.level = level, .trigger = fields.trigger};
    for (const std::string_view part : text) line.text.append(part);
    line.camera.append(fields.camera);
    line.fault.append(fields.fault);
  }
  thread_.wake();
}

std::optional<LogWriter::Waiting> LogWriter::next() {
  const std::lock_guard lock(queue_);
  if (count_ == 0) return std::nullopt;
  const Waiting& line = waiting_[oldest_];
  oldest_ = (oldest_ + 1) % kMaxWaiting;
  --count_;
  return line;
}

/// With writing_ held.
void LogWriter::write_waiting() {
  while (const auto line = next()) {
    output_(
        {line->level, line->text.view(), {line->camera.view(), line->fault.view(), line->trigger}});
  }
  write_dropped();
}

void LogWriter::write_dropped() {
  std::uint64_t dropped = 0;
  {
    const std::lock_guard lock(queue_);
    dropped = std::exchange(dropped_, 0);
  }
  if (dropped == 0) return;
  output_({LogLevel::Warning,
           std::to_string(dropped) + " lines were dropped: the log was not read in time",
           {}});
}

}  // namespace orbwatch::app
