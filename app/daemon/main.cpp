#include <getopt.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/daemon/attempts.h"
#include "app/daemon/build.h"
#include "app/daemon/cameras.h"
#include "app/daemon/dispatch.h"
#include "app/daemon/interfaces.h"
#include "app/files/resolve.h"
#include "app/health/board_health.h"
#include "app/health/health_sampler.h"
#include "app/log.h"
#include "app/ports/lines/lines.h"
#include "app/ports/snapshot/snapshot_sink.h"
#include "app/state/command_record.h"
#include "app/state/state_folder.h"
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

HealthSources health_sources(const Configuration& configuration) {
  HealthSources sources;
  if (configuration.snapshot) sources.disk = configuration.snapshot->folder;
  return sources;
}

/// The lines as configured; simulated ones are connected as the machine's settings say.
std::unique_ptr<Lines> open_lines(const Configuration& site) {
  const std::vector<LineSettings> settings{site.lines.begin(), site.lines.end()};
  return std::make_unique<Lines>(settings, [machine = site.simulation](const std::string& line) {
    return simulation::is_connected(machine, line);
  });
}

/// Adds to the plan what runs: cameras, their triggers, process inputs. A camera that cannot be
/// opened is absent.
Result<PipelinePlan> open_site(const Resolved& site, Lines& lines) {
  auto cameras = make_cameras(site);
  if (!cameras) return tl::unexpected(cameras.error());
  CameraSet absent;
  std::vector<hal::StreamFormat> formats;
  for (std::size_t i = 0; i < cameras->size(); ++i) {
    const auto format = open_camera(*(*cameras)[i], site, i);
    absent[i] = !format;
    formats.push_back(format.value_or(expected_format(site, i)));
  }
  auto plan = build(site, std::move(formats));
  if (!plan) return plan;
  for (std::size_t i = 0; i < cameras->size(); ++i) {
    const CameraSettings& settings = site.site.cameras[i];
    plan->triggers.push_back(
        lines.trigger(settings.trigger, settings.trigger_source, *(*cameras)[i]));
  }
  plan->cameras = std::move(*cameras);
  plan->absent = absent;
  plan->process_inputs = lines.process_inputs();
  return plan;
}

/// Opens an absent camera and has the pipeline take it up.
Result<> take_up(const Resolved& site, std::size_t index, hal::Camera& camera, Pipeline& pipeline) {
  const auto missing = [&](const hal::FaultReport& fault) {
    pipeline.miss(index, fault.fault);
    return fail("camera " + site.site.cameras[index].name + ": " + fault.detail);
  };
  const auto format = open_camera(camera, site, index);
  if (!format) return missing(format.error());
  if (format->format != pipeline.formats()[index].format) {
    std::vector<hal::StreamFormat> formats = pipeline.formats();
    formats[index] = *format;
    auto recompiled = rebuild(site, std::move(formats), index);
    if (!recompiled) return missing({hal::Fault::WrongFormat, recompiled.error().message});
    if (auto taken = pipeline.take_over(std::move(*recompiled)); !taken) return taken;
  }
  if (const auto admitted = pipeline.admit(index, *format); !admitted) {
    return missing({hal::Fault::Refused, admitted.error().message});
  }
  return {};
}

/// Runs until a signal. True: to be started again.
Result<bool> run(const Resolved& site, const sigset_t& signals, const std::filesystem::path& file) {
  const Configuration& configuration = site.site;
  const auto record = std::make_shared<CommandRecord>(state_folder(configuration.state_folder));
  HealthSampler health(
      [record, board = std::make_shared<BoardHealth>(health_sources(configuration))] {
        Health read = board->read();
        read.commands_recorded = record->is_kept() ? 1 : 0;
        return read;
      });
  std::optional<Pipeline> pipeline;  // outlives the lines, which trigger its cameras
  const auto lines = open_lines(configuration);
  auto plan = open_site(site, *lines);
  if (!plan) return tl::unexpected(plan.error());
  std::optional<SnapshotSink> snapshots;
  if (configuration.snapshot) snapshots.emplace(*configuration.snapshot);
  std::optional<Receivers> receivers;
  Interfaces interfaces(
      site, [&](const Command& command) { return dispatch(command, *receivers); }, record,
      snapshots ? &*snapshots : nullptr);
  plan->surroundings = [&](hal::TimePoint now) {
    return Surroundings{health.latest(now), lines->faults(), interfaces.faults()};
  };
  const CameraSet absent = plan->absent;
  std::vector<hal::Camera*> cameras;
  for (const auto& camera : plan->cameras) cameras.push_back(camera.get());
  pipeline.emplace(std::move(*plan));
  receivers.emplace(Receivers{*pipeline, *lines, snapshots ? &*snapshots : nullptr,
                              [] { ::kill(::getpid(), SIGHUP); }});

  Attempts attempts;
  attempts.add(
      "lines", [&] { return lines->start(); }, hal::Clock::now());
  interfaces.start(attempts, hal::Clock::now());
  health.start();
  std::vector<Sink*> sinks = interfaces.sinks();
  sinks.insert(sinks.begin(), lines.get());
  if (auto started = pipeline->start(sinks); !started) return tl::unexpected(started.error());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (!absent[i]) continue;
    attempts.add(
        "camera " + configuration.cameras[i].name,
        [&, i] { return take_up(site, i, *cameras[i], *pipeline); }, hal::Clock::now());
  }
  log_line(LogLevel::Info, "runs with " + std::to_string(site.names.cameras.size()) + " cameras, " +
                               std::to_string(site.names.views.size()) + " views and " +
                               std::to_string(site.recipes.size()) + " recipes, remap kernel " +
                               std::string(remap::default_kernel().name));
  log_line(LogLevel::Info, commanders_text(configuration.sinks));
  const bool restarts = wait_for_end(signals, file, attempts);
  pipeline->stop();
  interfaces.stop();
  lines->stop();
  return restarts;
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
