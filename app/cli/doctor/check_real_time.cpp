// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include "app/cli/doctor/checks.h"
#include "hal/thread/scheduling.h"

/// Checks of the conditions for the frame path's deadlines and time stamps.
namespace orbwatch::app::cli::doctor {
namespace {

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();
constexpr double kShareOfKernel = 0.95;  // share of real-time threads, the kernel's default
constexpr double kLongestWatchdog =
    14;  // s; on a Raspberry Pi before Linux 6.8, more than 15 s disables it

/// Owner of these limits, and the setting that raises them.
struct LimitOwner {
  std::string name;
  std::string remedy;
};

LimitOwner owner_of(const LimitFacts& limits, const std::string& line) {
  const std::string unit = "add " + line + ": sudo systemctl edit orbwatch";
  if (limits.of_service) return {"orbwatchd", unit};
  return {"this shell (orbwatchd does not run)", "sudo systemctl start orbwatch, then again"};
}

Diagnosis priority_diagnosis(const LimitFacts& limits) {
  const auto needed = static_cast<std::uint64_t>(hal::fifo_priority(hal::ThreadRole::Lines));
  const std::string line = "LimitRTPRIO=" + std::to_string(needed);
  const LimitOwner owner = owner_of(limits, line);
  if (limits.may_set_priority) return ok(owner.name + " may use any priority");
  if (!limits.realtime_priority) return warning("the limit of priorities cannot be read", line);
  const std::string text =
      owner.name + " may use real-time priorities to " + std::to_string(*limits.realtime_priority);
  if (*limits.realtime_priority >= needed) return ok(text);
  return warning(text + ", " + std::to_string(needed) + " is needed: other programs delay frames",
                 owner.remedy);
}

Diagnosis memory_diagnosis(const LimitFacts& limits) {
  const LimitOwner owner = owner_of(limits, "LimitMEMLOCK=infinity");
  if (limits.may_lock_memory || limits.locked_memory == kNoLimit) {
    return ok(owner.name + " may lock its memory");
  }
  return warning(owner.name + " may not lock its memory: it can be swapped out", owner.remedy);
}

Diagnosis runtime_diagnosis(const LimitFacts& limits) {
  const auto& runtime = limits.realtime_runtime;
  const auto& period = limits.realtime_period;
  const std::string remedy = "sudo sysctl -w kernel.sched_rt_runtime_us=950000";
  if (!runtime || !period || *period <= 0) return ok("the kernel states no share of threads");
  if (*runtime < 0) return ok("real-time threads have the whole processor");
  const double share = static_cast<double>(*runtime) / static_cast<double>(*period);
  const std::string text =
      "real-time threads have " + std::to_string(std::lround(100 * share)) + " % of the processor";
  return share < kShareOfKernel - 0.001 ? warning(text, remedy) : ok(text);
}

Diagnosis systemd_diagnosis(const WatchdogFacts& watchdog) {
  const double seconds = *watchdog.systemd_timeout;
  const std::string remedy =
      "RuntimeWatchdogSec=14s in /etc/systemd/system.conf, then sudo systemctl daemon-reexec";
  if (!(seconds > 0) || std::isinf(seconds)) {
    return warning("systemd does not feed it: a board that hangs stays so", remedy);
  }
  const std::string text = "systemd feeds it, " + std::to_string(std::lround(seconds)) + " s";
  if (seconds <= kLongestWatchdog) return ok(text);
  return warning(text + ": above 14 s it is silently off on some boards", remedy);
}

}  // namespace

Diagnoses check_real_time(const Facts& facts) {
  Diagnoses found;
  if (!facts.limits.cores_error.empty()) {
    found.push_back(fault(facts.limits.cores_error, "mend cores in [threads]; nproc counts them"));
  }
  const hal::ThreadSettings settings = facts.site ? facts.site->threads : hal::ThreadSettings{};
  if (settings.realtime) {
    found.push_back(priority_diagnosis(facts.limits));
    found.push_back(runtime_diagnosis(facts.limits));
  }
  if (settings.lock_memory) found.push_back(memory_diagnosis(facts.limits));
  return found;
}

Diagnoses check_clock(const Facts& facts) {
  Diagnoses found;
  const Health& health = facts.health;
  if (!signals::is_valid(health.clock_synchronised)) {
    found.push_back(warning("whether it follows a time server is unknown", "timedatectl"));
  } else if (health.clock_synchronised < 1) {
    found.push_back(warning("it follows no time server: time stamps may be wrong",
                            "sudo timedatectl set-ntp true"));
  } else {
    found.push_back(ok("it follows a time server"));
  }
  if (facts.has_battery_clock) {
    found.push_back(ok("/dev/rtc0 keeps the time without power, if its battery is fitted"));
    return found;
  }
  const std::string how = facts.board.known ? facts.board.known->battery_clock : "";
  found.push_back(
      warning("no battery clock: after a power cut the time is wrong until a time "
              "server answers",
              how.empty() ? "fit a battery clock, or a time server in this network" : how));
  return found;
}

Diagnoses check_watchdog(const Facts& facts) {
  const WatchdogFacts& watchdog = facts.watchdog;
  if (!watchdog.is_there) {
    return {warning("/dev/watchdog is not there: a board that hangs stays so",
                    "sudo modprobe softdog, or the driver of the board's watchdog")};
  }
  Diagnoses found;
  if (watchdog.systemd_timeout) found.push_back(systemd_diagnosis(watchdog));
  if (watchdog.state == "inactive" && (found.empty() || found.back().level == Level::Ok)) {
    found.push_back(warning("the kernel says that nobody feeds /dev/watchdog",
                            "sudo systemctl daemon-reexec, then journalctl -b -g watchdog"));
  }
  if (found.empty()) {
    const bool is_fed = watchdog.state == "active";
    found.push_back(ok(is_fed ? "/dev/watchdog is fed"
                              : "/dev/watchdog is there; whether systemd feeds it is unknown"));
  }
  return found;
}

}  // namespace orbwatch::app::cli::doctor
