// SPDX-License-Identifier: Apache-2.0
#include "app/cli/configure/await_trial.h"

#include <string>
#include <thread>

#include "app/cli/progress.h"
#include "app/files/runtime/trial.h"

namespace orbwatch::app::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPause(50);

/// Waits for the condition. False: it was not fulfilled in time.
template <class Condition>
bool is_fulfilled(std::chrono::milliseconds patience, const Condition& condition) {
  const auto end = Clock::now() + patience;
  while (!condition()) {
    if (Clock::now() >= end) return false;
    std::this_thread::sleep_for(kPause);
  }
  return true;
}

/// True if the trial runs, is confirmed already, or waits for a daemon.
bool is_alive(const std::filesystem::path& folder) {
  const auto running = files::running_trial(folder), confirmed = files::confirmed_trial(folder);
  return files::is_trial_requested(folder) || !running || *running || !confirmed || *confirmed;
}

}  // namespace

Result<> await_trial(const std::filesystem::path& folder, const std::string& unit,
                     const TrialPatience& patience) {
  Progress progress;
  progress.begin("waiting for orbwatchd");
  const auto is_taken = [&] { return !files::is_trial_requested(folder); };
  if (!is_fulfilled(patience.taken, is_taken)) {
    if (const auto withdrawn = files::cancel_trial(folder); !withdrawn) return withdrawn;
    return fail(
        "no orbwatchd has taken it up, and the request is withdrawn: see that the service "
        "runs (systemctl status " +
        unit + ") and keeps its state in " + folder.string());
  }
  Result<std::optional<std::string>> report;
  const auto is_known = [&] {
    const bool was_alive =
        is_alive(folder);  // read before the report, which is written before the end
    report = files::trial_report(folder);
    return !report || *report || !was_alive;
  };
  const bool is_over = is_fulfilled(patience.started, is_known);
  if (!report) return tl::unexpected(report.error());
  if (!*report) {
    const char* const what =
        is_over ? "it ended before it ran, and the files count again; the log of orbwatchd says why"
                : "orbwatchd has taken it up and does not say that it runs; see its log";
    return fail(std::string(what) + " (journalctl -u " + unit + ")");
  }
  if (!(*report)->empty()) return fail("orbwatchd does not run it: " + **report);
  return {};
}

}  // namespace orbwatch::app::cli
