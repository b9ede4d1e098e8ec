// SPDX-License-Identifier: Apache-2.0
#include "app/service/service_manager.h"

#include <systemd/sd-daemon.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "app/log.h"

namespace orbwatch::app {
namespace {

/// Longest start, equal to TimeoutStartSec of platform/service/orbwatch.service: compiling the
/// views of a large site.
constexpr std::chrono::microseconds kLongestStart = std::chrono::minutes(3);

std::string microseconds(std::chrono::microseconds time) { return std::to_string(time.count()); }

/// Time of CLOCK_MONOTONIC, which systemd requires with RELOADING=1.
std::string monotonic_now() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return microseconds(
      std::chrono::seconds(now.tv_sec) +
      std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::nanoseconds(now.tv_nsec)));
}

}  // namespace

bool has_service_manager() { return std::getenv("NOTIFY_SOCKET") != nullptr; }

std::chrono::microseconds watchdog_period() {
  std::uint64_t period = 0;
  return std::chrono::microseconds(::sd_watchdog_enabled(0, &period) > 0 ? period : 0);
}

void notify(const std::string& assignments) {
  static std::atomic<bool> is_logged{false};
  const int result = ::sd_notify(0, assignments.c_str());
  if (result >= 0 || is_logged.exchange(true)) return;
  log_line(LogLevel::Warning,
           std::string("the service manager does not read: ") + std::strerror(-result));
}

std::string ready_message(std::string_view status) {
  std::string message = "READY=1\nSTATUS=" + std::string(status);
  const auto period = watchdog_period();
  if (period.count() > 0) message += "\nWATCHDOG_USEC=" + microseconds(period) + "\nWATCHDOG=1";
  return message;
}

void notify_restart() {
  std::string message = "RELOADING=1\nMONOTONIC_USEC=" + monotonic_now() +
                        "\nSTATUS=restarting with its files read again";
  if (watchdog_period().count() > 0) {
    message += "\nWATCHDOG_USEC=" + microseconds(kLongestStart) + "\nWATCHDOG=1";
  }
  notify(message);
}

void notify_end() { notify("STOPPING=1\nSTATUS=ends"); }

}  // namespace orbwatch::app
