// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <sstream>

#include "app/cli/doctor/gather.h"
#include "app/health/system_file.h"
#include "hal/thread/scheduling.h"

/// Limits of the kernel for the service, or for this program.
namespace orbwatch::app::cli::doctor {
namespace {

namespace fs = std::filesystem;

// Numbers of capabilities in linux/capability.h.
constexpr unsigned kIpcLock = 14, kSysNice = 23;

/// The soft limit in a line of /proc/PID/limits.
std::optional<std::uint64_t> soft_limit(const std::string& limits, std::string_view name) {
  std::istringstream lines(limits);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(name)) continue;
    std::istringstream words(line.substr(name.size()));
    std::string soft;
    words >> soft;
    if (soft == "unlimited") return std::numeric_limits<std::uint64_t>::max();
    const auto number = to_integer(soft);
    if (!number || *number < 0) return std::nullopt;
    return static_cast<std::uint64_t>(*number);
  }
  return std::nullopt;
}

/// The effective capabilities in /proc/PID/status; none if it cannot be read.
std::uint64_t capabilities(const fs::path& process) {
  std::istringstream lines(read_system_file(process / "status").value_or(""));
  for (std::string line; std::getline(lines, line);) {
    constexpr std::string_view kKey = "CapEff:";
    if (!line.starts_with(kKey)) continue;
    const auto bits = to_integer(std::string_view(line).substr(kKey.size()), 16);
    return bits && *bits >= 0 ? static_cast<std::uint64_t>(*bits) : 0;
  }
  return 0;
}

}  // namespace

std::vector<fs::path> processes_of(const fs::path& proc, std::string_view name) {
  std::vector<fs::path> found;
  for (const fs::path& process : entries(proc)) {
    if (!to_integer(process.filename().native())) continue;
    if (read_system_file(process / "comm") == std::string(name) + "\n") found.push_back(process);
  }
  return found;
}

void gather_limits(const Sources& sources, Facts& facts) {
  LimitFacts& limits = facts.limits;
  const fs::path proc = sources.at("/proc");
  const auto services = processes_of(proc, "orbwatchd");
  limits.of_service = !services.empty();
  const fs::path process = limits.of_service ? services.front() : proc / "self";
  const std::string text = read_system_file(process / "limits").value_or("");
  limits.realtime_priority = soft_limit(text, "Max realtime priority");
  limits.locked_memory = soft_limit(text, "Max locked memory");
  const std::uint64_t bits = capabilities(process);
  limits.may_set_priority = (bits >> kSysNice & 1) != 0;
  limits.may_lock_memory = (bits >> kIpcLock & 1) != 0;
  const fs::path kernel = proc / "sys/kernel";
  limits.realtime_runtime = read_integer(kernel / "sched_rt_runtime_us");
  limits.realtime_period = read_integer(kernel / "sched_rt_period_us");
  if (facts.site) {
    const auto cores = hal::check(facts.site->threads);
    if (!cores) limits.cores_error = cores.error().message;
  }
}

}  // namespace orbwatch::app::cli::doctor
