#include "app/dds/dds_log.h"

#include <dds/ddsrt/log.h>

#include <chrono>
#include <cstdio>
#include <mutex>
#include <utility>

namespace orbwatch::app {

namespace {

constexpr int kLinesPerMinute = 20;

void write_line(void*, const dds_log_data_t* line) {
  static std::mutex mutex;
  static LineBudget budget(kLinesPerMinute);
  const std::lock_guard lock(mutex);
  const auto withheld = budget.admit(hal::Clock::now());
  if (!withheld) return;
  if (*withheld > 0) {
    std::fprintf(stderr, "DDS: %llu log lines withheld\n",
                 static_cast<unsigned long long>(*withheld));
  }
  // The message ends with its line feed.
  std::fprintf(stderr, "DDS: %s", line->message);
}

}  // namespace

std::optional<std::uint64_t> LineBudget::admit(hal::TimePoint now) {
  if (!minute_ || now - *minute_ >= std::chrono::minutes(1)) {
    minute_ = now;
    used_ = 0;
  }
  if (used_ >= limit_) {
    ++withheld_;
    return std::nullopt;
  }
  ++used_;
  return std::exchange(withheld_, 0);
}

void limit_dds_log() {
  static std::once_flag once;
  std::call_once(once, [] { dds_set_log_sink(write_line, nullptr); });
}

}  // namespace orbwatch::app
