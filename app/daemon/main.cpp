#include <getopt.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <string>
#include <utility>

#include "app/daemon/appliance.h"
#include "app/daemon/attempts.h"
#include "app/daemon/build.h"
#include "app/daemon/configuration_choice.h"
#include "app/daemon/installed_configuration.h"
#include "app/daemon/interfaces.h"
#include "app/exit_status.h"
#include "app/files/resolve.h"
#include "app/files/site_file.h"
#include "app/files/trial.h"
#include "app/log.h"
#include "app/log_writer.h"
#include "app/recent_log.h"
#include "app/service/journal.h"
#include "app/service/progress_notice.h"
#include "app/service/service_manager.h"
#include "app/version.h"
#include "proc/remap/remap.h"

namespace orbwatch::app {
namespace {

constexpr const char* kHelp =
    "Usage: orbwatchd [--config FILE] [--check]\n"
    "\n"
    "Turns pictures of a mirror ball into views, measures the process in them and reports over\n"
    "DDS and Modbus. Runs until SIGTERM or Ctrl-C; SIGHUP starts it again with its files read\n"
    "anew, unless they are wrong. As a service, with STATE_DIRECTORY set, it keeps there what ran\n"
    "last and runs that if the files are wrong at the start.\n"
    "\n"
    "  --config FILE  cameras, views and interfaces (TOML); names the files of rig and recipes;\n"
    "                 else that of the environment's ORBWATCH_CONFIG, or /etc/orbwatch/site.toml.\n"
    "                 `orbwatch describe config`, `... rig` and `... recipe` print the manuals\n"
    "  --check        read and check all these files and all that follows from them, say who may\n"
    "                 command, then exit\n"
    "  --help, --version\n";

struct Arguments {
  std::filesystem::path config;
  bool check = false;
};

/// Nullopt: main returns `status`.
std::optional<Arguments> parse(int argc, char** argv, ExitStatus& status) {
  constexpr option kOptions[] = {{"config", required_argument, nullptr, 'c'},
                                 {"check", no_argument, nullptr, 'k'},
                                 {"help", no_argument, nullptr, 'h'},
                                 {"version", no_argument, nullptr, 'v'},
                                 {nullptr, 0, nullptr, 0}};
  Arguments arguments;
  status = ExitStatus::Done;
  for (int option = 0; (option = getopt_long(argc, argv, "", kOptions, nullptr)) != -1;) {
    if (option == 'c') arguments.config = optarg;
    if (option == 'k') arguments.check = true;
    if (option == 'h') std::cout << kHelp;
    if (option == 'v') std::cout << version_text("orbwatchd");
    if (option == 'h' || option == 'v') return std::nullopt;
    if (option == '?') status = ExitStatus::WrongUsage;
  }
  if (status == ExitStatus::Done && optind < argc) {
    log_line(LogLevel::Error, std::string("unexpected argument ") + argv[optind]);
    status = ExitStatus::WrongUsage;
  }
  // As `orbwatch configure` names it in a trial.
  arguments.config = std::filesystem::absolute(site_file(arguments.config)).lexically_normal();
  return status == ExitStatus::Done ? std::optional(arguments) : std::nullopt;
}

/// Signals that end or restart are delivered to the one thread that waits for them.
sigset_t block_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

/// How often a service looks for the request of a trial, which comes as a file.
constexpr std::chrono::seconds kTrialPause{1};

/// What the main thread waits for besides signals.
struct Waiting {
  const std::filesystem::path file;
  const std::optional<std::filesystem::path> folder = service_folder();
  hal::TimePoint trial_ends = hal::TimePoint::max();  ///< max: no trial runs
  std::uint32_t checksum = 0;                         ///< of what runs

  hal::TimePoint due(const Attempts& attempts) const {
    const auto next = std::min(attempts.due(), trial_ends);
    return folder ? std::min(next, hal::Clock::now() + kTrialPause) : next;
  }
};

/// 0: none came until `due`.
int wait_for_signal(const sigset_t& signals, hal::TimePoint due) {
  if (due == hal::TimePoint::max()) {
    int signal = 0;
    return sigwait(&signals, &signal) == 0 ? signal : 0;
  }
  const auto left = std::max(hal::Clock::duration(0), due - hal::Clock::now());
  const auto seconds = std::chrono::floor<std::chrono::seconds>(left);
  // 32 bit on armhf.
  const timespec timeout{
      static_cast<std::time_t>(seconds.count()),
      static_cast<decltype(timespec::tv_nsec)>(std::chrono::nanoseconds(left - seconds).count())};
  return std::max(0, sigtimedwait(&signals, nullptr, &timeout));
}

/// A trial is requested, or the one that runs has ended: by its time, or cancelled. A confirmed one
/// goes on, it is what the files say.
bool asks_for_restart(Waiting& waiting) {
  if (!waiting.folder) return false;
  if (is_trial_requested(*waiting.folder)) return true;
  if (waiting.trial_ends == hal::TimePoint::max()) return false;
  const auto running = running_trial(*waiting.folder);
  if (running && !*running) {
    const auto confirmed = confirmed_trial(*waiting.folder);
    if (confirmed && *confirmed) return false;  // its files are being written
    waiting.trial_ends = hal::TimePoint::max();
    const auto files = resolve(waiting.file);
    return !files || files->checksum != waiting.checksum;
  }
  return hal::Clock::now() >= waiting.trial_ends;
}

/// Waits for the end, and takes up what is missing. A restart with wrong files is refused here, and
/// the daemon keeps running. True: start again.
bool wait_for_end(const sigset_t& signals, Waiting waiting, Appliance& appliance) {
  while (true) {
    const int signal = wait_for_signal(signals, waiting.due(appliance.attempts()));
    if (signal == SIGTERM || signal == SIGINT) {
      log_line(LogLevel::Info, "ended by signal " + std::to_string(signal));
      return false;
    }
    appliance.attempts().run(hal::Clock::now());
    if (asks_for_restart(waiting)) {
      log_line(LogLevel::Info, "restarts for another configuration");
      return true;
    }
    if (signal != SIGHUP) continue;
    const auto checked = check_restart(waiting.file);
    if (checked) {
      log_line(LogLevel::Info, "restarts with its files read again");
      return true;
    }
    log_line(LogLevel::Error, "does not restart: " + checked.error().message);
    appliance.report_refused_configuration();
  }
}

/// The notice is one of its watchers if someone reads it.
Result<> start(Appliance& appliance, ProgressNotice& notice) {
  if (!has_service_manager()) return appliance.start();
  return notice.start().and_then([&] { return appliance.start({&notice}); });
}

/// Runs until a signal. True: to be started again.
Result<bool> run(const Chosen& chosen, const sigset_t& signals, const std::filesystem::path& file,
                 std::shared_ptr<const RecentLog> log) {
  ProgressNotice notice(chosen.refusal);  // outlives the run
  const auto files = std::make_shared<InstalledConfiguration>(file, chosen);
  auto appliance = Appliance::make(
      chosen.site, [] { ::kill(::getpid(), SIGHUP); },
      {files, std::move(log), versions("orbwatchd"), commanders_text(chosen.site.site.sinks)});
  if (!appliance) return tl::unexpected(appliance.error());
  if (!chosen.refusal.empty()) (*appliance)->report_refused_configuration();
  if (auto started = start(**appliance, notice); !started) return tl::unexpected(started.error());
  keep(chosen);
  Waiting waiting{.file = file, .checksum = chosen.site.checksum};
  if (chosen.trial) {
    waiting.trial_ends = hal::Clock::now() + std::chrono::seconds(chosen.trial->seconds);
    files->set_trial_end(waiting.trial_ends);
  }
  const bool restarts = wait_for_end(signals, waiting, **appliance);
  restarts ? notify_restart() : notify_end();
  return restarts;
}

Result<> check(const std::filesystem::path& file) {
  const auto site = resolve(file);
  if (!site) return tl::unexpected(site.error());
  return check_site(*site, Dates::Checked).map([&] {
    log_line(LogLevel::Info, commanders_text(site->site.sinks));
  });
}

/// The same program with the same arguments; returns only when that fails.
Result<> start_again(LogWriter& log, char** argv) {
  log.flush();
  ::execv("/proc/self/exe", argv);
  return fail(std::string("cannot start again: ") + std::strerror(errno));
}

ExitStatus main(int argc, char** argv) {
  ExitStatus status = ExitStatus::Done;
  const auto arguments = parse(argc, argv, status);
  if (!arguments) return status;
  const sigset_t signals = block_signals();
  const auto recent = std::make_shared<RecentLog>();
  LogWriter log([recent, output = log_output()](const LogRecord& record) {
    recent->add(record);
    output(record);
  });
  const auto kernel = remap::requested_kernel();
  Result<> result;
  if (!kernel) {
    result = tl::unexpected(kernel.error());
  } else if (arguments->check) {
    result = check(arguments->config);
  } else {
    result = choose(arguments->config)
                 .and_then([&](const Chosen& chosen) {
                   return run(chosen, signals, arguments->config, recent);
                 })
                 .and_then(
                     [&](bool restarts) { return restarts ? start_again(log, argv) : Result<>(); });
  }
  if (result) return ExitStatus::Done;
  log_line(LogLevel::Error, result.error().message);
  return ExitStatus::Failed;
}

}  // namespace
}  // namespace orbwatch::app

int main(int argc, char** argv) {
  // OpenCV would share every call among all cores, the frame path's too.
  cv::setNumThreads(1);
  return static_cast<int>(orbwatch::app::main(argc, argv));
}
