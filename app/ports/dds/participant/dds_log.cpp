#include "app/ports/dds/participant/dds_log.h"

#include <dds/ddsrt/log.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <string_view>

#include "app/ports/dds/participant/rate_limit.h"

namespace orbwatch::app {

namespace {

constexpr int kLinesPerMinute = 20;

std::atomic<std::uint64_t> malformed{0};

/// Cyclone DDS has no counters for these.
bool is_of_a_bad_sample(std::string_view message) {
  const auto has = [message](std::string_view part) {
    return message.find(part) != std::string_view::npos;
  };
  return has(": deserialization ") || (has("dropping oversize ") && has(" from remote writer "));
}

void write_line(void*, const dds_log_data_t* line) {
  if (is_of_a_bad_sample(line->message)) ++malformed;
  static std::mutex mutex;
  static RateLimit budget(kLinesPerMinute, std::chrono::minutes(1));
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

std::uint64_t malformed_samples() { return malformed; }

void limit_dds_log() {
  static std::once_flag once;
  std::call_once(once, [] { dds_set_log_sink(write_line, nullptr); });
}

}  // namespace orbwatch::app
