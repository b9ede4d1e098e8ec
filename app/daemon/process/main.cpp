// SPDX-License-Identifier: Apache-2.0
#include <getopt.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <string>
#include <utility>

#include "app/daemon/process/supervision.h"
#include "app/daemon/site/assumptions.h"
#include "app/daemon/site/interfaces.h"
#include "app/daemon/site/site_check.h"
#include "app/exit_status.h"
#include "app/files/resolve.h"
#include "app/files/runtime/site_file.h"
#include "app/log.h"
#include "app/log_writer.h"
#include "app/recent_log.h"
#include "app/service/journal.h"
#include "app/version.h"
#include "proc/remap/remap.h"

namespace orbwatch::app::daemon {
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
  arguments.config =
      std::filesystem::absolute(files::site_file(arguments.config)).lexically_normal();
  return status == ExitStatus::Done ? std::optional(arguments) : std::nullopt;
}

Result<> check(const std::filesystem::path& file) {
  const auto site = files::resolve(file);
  if (!site) return tl::unexpected(site.error());
  return checked_plan(*site, Dates::Checked).map([&](const SitePlan& plan) {
    for (const std::string& line : assumptions(*site, plan)) log_line(LogLevel::Info, line);
    log_line(LogLevel::Info, commanders_text(site->site.sinks));
  });
}

/// The same program with the same arguments, without what an end that hangs has left open; returns
/// only when that fails.
Result<> start_again(char** argv) {
  if (::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC) != 0) {
    log_soon(LogLevel::Warning, {"open files stay open: ", std::strerror(errno)});
  }
  ::execv("/proc/self/exe", argv);
  return fail(std::string("cannot start again: ") + std::strerror(errno));
}

ExitStatus status_of(const Result<>& result) {
  if (result) return ExitStatus::Done;
  log_line(LogLevel::Error, result.error().message);
  return ExitStatus::Failed;
}

/// Status of an end that did not fail.
ExitStatus status_of(Supervision::End end) {
  switch (end) {
    case Supervision::End::Stop:
    case Supervision::End::Restart:
      return ExitStatus::Done;
    case Supervision::End::StopLine:
      return ExitStatus::StopLine;
    case Supervision::End::PowerOff:
      return ExitStatus::PowerOff;
    case Supervision::End::RestartDevice:
      return ExitStatus::RestartDevice;
  }
  return ExitStatus::Failed;
}

/// Runs until a signal. Does not return after an end that hangs, or that the log does not take.
ExitStatus run(const sigset_t& signals, const std::filesystem::path& file,
               std::shared_ptr<const RecentLog> recent, LogWriter& log, char** argv) {
  Supervision supervision(signals, file, std::move(recent));
  const auto end = supervision.run();
  if (!end) return status_of(tl::unexpected(end.error()));
  const bool is_orderly = supervision.finish(*end);
  ExitStatus status = status_of(*end);
  if (*end == Supervision::End::Restart) {
    log.flush(Supervision::kLongestAbandonment);
    status = status_of(start_again(argv));
  } else if (*end == Supervision::End::Stop && is_orderly) {
    status = status_of(supervision.result());
  }
  const bool is_logged = log.flush(Supervision::kLongestAbandonment);
  if (!is_orderly || !is_logged) ::_exit(static_cast<int>(status));
  return status;
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
  if (!kernel) return status_of(tl::unexpected(kernel.error()));
  if (arguments->check) return status_of(check(arguments->config));
  return run(signals, arguments->config, recent, log, argv);
}

}  // namespace
}  // namespace orbwatch::app::daemon

int main(int argc, char** argv) {
  // After start_again() the kernel calls the process "exe"; `orbwatch doctor` and people look for
  // this.
  ::prctl(PR_SET_NAME, "orbwatchd");
  // OpenCV would share every call among all cores, the frame path's too.
  cv::setNumThreads(1);
  return static_cast<int>(orbwatch::app::daemon::main(argc, argv));
}
