#include <getopt.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "app/daemon/appliance.h"
#include "app/daemon/attempts.h"
#include "app/daemon/build.h"
#include "app/daemon/interfaces.h"
#include "app/files/resolve.h"
#include "app/log.h"
#include "app/version.h"
#include "proc/remap/remap.h"

namespace orbwatch::app {
namespace {

constexpr const char* kHelp =
    "Usage: orbwatchd --config FILE [--check]\n"
    "\n"
    "Turns pictures of a mirror ball into views, measures the process in them and reports over\n"
    "DDS and Modbus. Runs until SIGTERM or Ctrl-C; SIGHUP starts it again with its files read\n"
    "anew, unless they are wrong.\n"
    "\n"
    "  --config FILE  cameras, views and interfaces (TOML); names the files of rig and recipes.\n"
    "                 `orbwatch describe config`, `... rig` and `... recipe` print the manuals\n"
    "  --check        read and check all these files and all that follows from them, say who may\n"
    "                 command, then exit\n"
    "  --help, --version\n";

struct Arguments {
  std::optional<std::filesystem::path> config;
  bool check = false;
};

/// Nullopt: main returns `exit_code`.
std::optional<Arguments> parse(int argc, char** argv, int& exit_code) {
  constexpr option kOptions[] = {{"config", required_argument, nullptr, 'c'},
                                 {"check", no_argument, nullptr, 'k'},
                                 {"help", no_argument, nullptr, 'h'},
                                 {"version", no_argument, nullptr, 'v'},
                                 {nullptr, 0, nullptr, 0}};
  Arguments arguments;
  exit_code = 0;
  for (int option = 0; (option = getopt_long(argc, argv, "", kOptions, nullptr)) != -1;) {
    if (option == 'c') arguments.config = optarg;
    if (option == 'k') arguments.check = true;
    if (option == 'h') std::cout << kHelp;
    if (option == 'v') std::cout << version_text("orbwatchd");
    if (option == 'h' || option == 'v') return std::nullopt;
    if (option == '?') exit_code = 2;
  }
  if (exit_code == 0 && (!arguments.config || optind < argc)) {
    log_line(LogLevel::Error, !arguments.config
                                  ? "--config FILE is missing; see --help"
                                  : std::string("unexpected argument ") + argv[optind]);
    exit_code = 2;
  }
  return exit_code == 0 ? std::optional(arguments) : std::nullopt;
}

/// Signals that end or restart are delivered to the one thread that waits for them.
sigset_t block_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

/// Waits for a signal, and makes attempts meanwhile. 0: none came until they were due.
int wait_for_signal(const sigset_t& signals, const Attempts& attempts) {
  const hal::TimePoint due = attempts.due();
  if (due == hal::TimePoint::max()) {
    int signal = 0;
    return sigwait(&signals, &signal) == 0 ? signal : 0;
  }
  const auto left = std::max(hal::Clock::duration(0), due - hal::Clock::now());
  const auto seconds = std::chrono::floor<std::chrono::seconds>(left);
  const timespec timeout{seconds.count(), std::chrono::nanoseconds(left - seconds).count()};
  return std::max(0, sigtimedwait(&signals, nullptr, &timeout));
}

/// Waits for the end, and takes up what is missing. A restart with wrong files is refused here, and
/// the daemon keeps running. True: start again.
bool wait_for_end(const sigset_t& signals, const std::filesystem::path& file, Attempts& attempts) {
  while (true) {
    const int signal = wait_for_signal(signals, attempts);
    attempts.run(hal::Clock::now());
    if (signal == 0) continue;
    if (signal != SIGHUP) {
      log_line(LogLevel::Info, "ended by signal " + std::to_string(signal));
      return false;
    }
    const auto checked = resolve(file).and_then(
        [](const Resolved& site) { return check_site(site, Dates::Ignored); });
    if (checked) {
      log_line(LogLevel::Info, "restarts with its files read again");
      return true;
    }
    log_line(LogLevel::Error, "does not restart: " + checked.error().message);
  }
}

/// Runs until a signal. True: to be started again.
Result<bool> run(const Resolved& site, const sigset_t& signals, const std::filesystem::path& file) {
  auto appliance = Appliance::make(site, [] { ::kill(::getpid(), SIGHUP); });
  if (!appliance) return tl::unexpected(appliance.error());
  if (auto started = (*appliance)->start(); !started) return tl::unexpected(started.error());
  return wait_for_end(signals, file, (*appliance)->attempts());
}

/// The same program with the same arguments; returns only when that fails.
Result<> start_again(char** argv) {
  ::execv("/proc/self/exe", argv);
  return fail(std::string("cannot start again: ") + std::strerror(errno));
}

int main(int argc, char** argv) {
  int exit_code = 0;
  const auto arguments = parse(argc, argv, exit_code);
  if (!arguments) return exit_code;
  const sigset_t signals = block_signals();
  const auto site = resolve(*arguments->config);
  const auto kernel = remap::requested_kernel();
  Result<> result;
  if (!site) {
    result = tl::unexpected(site.error());
  } else if (!kernel) {
    result = tl::unexpected(kernel.error());
  } else if (arguments->check) {
    result = check_site(*site, Dates::Checked);
    if (result) log_line(LogLevel::Info, commanders_text(site->site.sinks));
  } else if (const auto keys = check_keys(*site, Dates::Ignored); !keys) {
    result = keys;
  } else {
    result = run(*site, signals, *arguments->config).and_then([&](bool restarts) {
      return restarts ? start_again(argv) : Result<>();
    });
  }
  if (result) return 0;
  log_line(LogLevel::Error, result.error().message);
  return 1;
}

}  // namespace
}  // namespace orbwatch::app

int main(int argc, char** argv) { return orbwatch::app::main(argc, argv); }
