#include <getopt.h>
#include <pthread.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "app/daemon/build.h"
#include "app/daemon/cameras.h"
#include "app/daemon/dispatch.h"
#include "app/daemon/sinks.h"
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

/// Waits for a signal. A restart with wrong files is refused here, and the daemon keeps running.
/// True: start again.
bool wait_for_end(const sigset_t& signals, const std::filesystem::path& file) {
  while (true) {
    int signal = 0;
    sigwait(&signals, &signal);
    if (signal != SIGHUP) {
      log_line(LogLevel::Info, "ended by signal " + std::to_string(signal));
      return false;
    }
    const auto checked = resolve(file).and_then(check_site);
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

/// Adds to the plan what runs: cameras, their triggers, process inputs.
Result<PipelinePlan> open_site(const Resolved& site, Lines& lines) {
  auto cameras = open_cameras(site);
  if (!cameras) return tl::unexpected(cameras.error());
  std::vector<hal::StreamFormat> formats;
  for (const OpenCamera& camera : *cameras) formats.push_back(camera.format);
  auto plan = build(site, std::move(formats));
  if (!plan) return plan;
  for (std::size_t i = 0; i < cameras->size(); ++i) {
    const CameraSettings& settings = site.site.cameras[i];
    hal::Camera& camera = *(*cameras)[i].camera;
    plan->triggers.push_back(lines.trigger(settings.trigger, settings.trigger_source, camera));
    plan->cameras.push_back(std::move((*cameras)[i].camera));
  }
  plan->process_inputs = lines.process_inputs();
  return plan;
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
  auto lines = Lines::open({configuration.lines.begin(), configuration.lines.end()});
  if (!lines) return tl::unexpected(lines.error());
  auto plan = open_site(site, **lines);
  if (!plan) return tl::unexpected(plan.error());
  plan->health = [&health](hal::TimePoint now) { return health.latest(now); };
  pipeline.emplace(std::move(*plan));
  std::optional<SnapshotSink> snapshots;
  if (configuration.snapshot) snapshots.emplace(*configuration.snapshot);
  const Receivers receivers{*pipeline, **lines, snapshots ? &*snapshots : nullptr,
                            [] { ::kill(::getpid(), SIGHUP); }};
  const auto made = make_sinks(
      site, [&](const Command& command) { return dispatch(command, receivers); }, record);
  std::vector<Sink*> sinks{lines->get()};
  if (snapshots) sinks.push_back(&*snapshots);
  for (const auto& sink : made) sinks.push_back(sink.get());
  for (Sink* sink : sinks) {
    if (auto started = sink->start(); !started) return tl::unexpected(started.error());
  }
  health.start();
  if (auto started = pipeline->start(sinks); !started) return tl::unexpected(started.error());
  log_line(LogLevel::Info, "runs with " + std::to_string(site.names.cameras.size()) + " cameras, " +
                               std::to_string(site.names.views.size()) + " views and " +
                               std::to_string(site.recipes.size()) + " recipes, remap kernel " +
                               std::string(remap::default_kernel().name));
  log_line(LogLevel::Info, commanders_text(configuration.sinks));
  const bool restarts = wait_for_end(signals, file);
  pipeline->stop();
  for (Sink* sink : sinks) sink->stop();
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
    result = check_site(*site);
    if (result) log_line(LogLevel::Info, commanders_text(site->site.sinks));
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
