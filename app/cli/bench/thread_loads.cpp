// SPDX-License-Identifier: Apache-2.0
#include "app/cli/bench/thread_loads.h"

#include <unistd.h>

#include <algorithm>
#include <sstream>
#include <string_view>

#include "app/health/system_file.h"
#include "proc/signals/signals.h"

namespace orbwatch::app::cli {
namespace {

/// Processor time in /proc/PID/task/TID/stat: the text after the name, which may contain blanks and
/// parentheses itself, begins with field 3; 14 and 15 are the ticks in user and in kernel mode
/// (proc(5)).
std::chrono::nanoseconds time_of(const std::string& stat) {
  std::istringstream fields(stat.substr(std::min(stat.size(), stat.rfind(')') + 1)));
  std::string skipped;
  for (int field = 3; field < 14; ++field) fields >> skipped;
  double user = 0, system = 0;
  fields >> user >> system;
  const double seconds = (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  return std::chrono::round<std::chrono::nanoseconds>(std::chrono::duration<double>(seconds));
}

}  // namespace

std::vector<ThreadLoad> thread_loads(const std::filesystem::path& proc) {
  std::vector<ThreadLoad> threads;
  for (const auto& task : entries(proc / "self/task")) {
    const auto id = to_integer(task.filename().native());
    const auto stat = read_system_file(task / "stat");
    auto name = read_system_file(task / "comm");
    if (!id || !stat || !name) continue;  // the thread has just ended
    while (!name->empty() && name->back() == '\n') name->pop_back();
    threads.push_back({static_cast<int>(*id), std::move(*name), time_of(*stat)});
  }
  std::ranges::sort(threads, {}, &ThreadLoad::id);
  return threads;
}

std::vector<ThreadLoad> since(const std::vector<ThreadLoad>& before,
                              std::vector<ThreadLoad> after) {
  for (ThreadLoad& thread : after) {
    const auto same = std::ranges::find(before, thread.id, &ThreadLoad::id);
    if (same != before.end()) thread.time -= same->time;
  }
  return after;
}

MemoryFigures memory_figures(const std::filesystem::path& proc) {
  const std::string status = read_system_file(proc / "self/status").value_or("");
  const auto mebibytes = [&status](std::string_view key) {
    std::istringstream lines(status);
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with(key) || !line.ends_with(" kB")) continue;
      const auto number = std::string_view(line).substr(key.size(), line.size() - key.size() - 3);
      const auto kibibytes = to_integer(number);
      return kibibytes ? static_cast<double>(*kibibytes) / 1024 : signals::kNotValid;
    }
    return signals::kNotValid;
  };
  return {mebibytes("VmRSS:"),   mebibytes("VmHWM:"),    mebibytes("RssAnon:"),
          mebibytes("RssFile:"), mebibytes("RssShmem:"), mebibytes("VmLck:")};
}

}  // namespace orbwatch::app::cli
