// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/participant/dds_log.h"

#include <dds/ddsrt/log.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

#include "app/log.h"
#include "app/ports/dds/participant/rate_limit.h"

namespace orbwatch::app::dds {

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

LogLevel level_of(std::uint32_t priority) {
  if ((priority & (DDS_LC_FATAL | DDS_LC_ERROR)) != 0) return LogLevel::Error;
  return (priority & DDS_LC_WARNING) != 0 ? LogLevel::Warning : LogLevel::Info;
}

/// Called on any thread of Cyclone DDS, or of ours that writes samples; does not wait for the log's
/// reader.
void write_line(void*, const dds_log_data_t* line) {
  std::string_view message = line->message;
  if (is_of_a_bad_sample(message)) ++malformed;
  static std::mutex mutex;
  static RateLimit budget(kLinesPerMinute, std::chrono::minutes(1));
  const std::lock_guard lock(mutex);
  const auto withheld = budget.admit(hal::Clock::now());
  if (!withheld) return;
  if (*withheld > 0) {
    log_soon(LogLevel::Warning, {"DDS: ", std::to_string(*withheld), " log lines withheld"});
  }
  if (message.ends_with('\n')) message.remove_suffix(1);
  log_soon(level_of(line->priority), {"DDS: ", message});
}

}  // namespace

std::uint64_t malformed_samples() { return malformed; }

void limit_dds_log() {
  static std::once_flag once;
  std::call_once(once, [] { dds_set_log_sink(write_line, nullptr); });
}

}  // namespace orbwatch::app::dds
