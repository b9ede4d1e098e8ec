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

#include "app/console/console_sink.h"
#include "app/daemon/assemble.h"
#include "app/daemon/check.h"
#include "app/daemon/dispatch.h"
#include "app/daemon/lines.h"
#include "app/dds/dds_sink.h"
#include "app/health/board_health.h"
#include "app/health/health_sampler.h"
#include "app/log.h"
#include "app/modbus/modbus_sink.h"
#include "app/snapshot/snapshot_sink.h"
#include "app/version.h"
#include "proc/remap/kernel.h"

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
    "  --check        read and check all these files and all that follows from them, then exit\n"
    "  --help, --version\n";

struct Arguments {
  std::optional<std::filesystem::path> config;
  bool check = false;
};

/// Nothing: say the exit code and end.
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

template <class Named>
std::vector<std::string> names(const std::vector<Named>& list) {
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const Named& item : list) names.push_back(item.name);
  return names;
}

StatusNames status_names(const Configuration& configuration) {
  StatusNames result{names(configuration.cameras), view_names(configuration), {}};
  for (const RecipeSettings& recipe : configuration.recipes) {
    result.regions[static_cast<std::uint16_t>(recipe.number)] = names(recipe.recipe.regions);
  }
  return result;
}

DdsSettings dds_settings(const Configuration& configuration) {
  DdsSettings settings = configuration.dds;
  const auto publish = [&settings](const ViewSettings& view, bool measured) {
    const bool perspective = view.kind == optics::ViewKind::Perspective;
    settings.views[view.name] = {view.encoding, perspective, measured};
  };
  for (const ViewSettings& view : configuration.views) publish(view, false);
  for (const RecipeSettings& recipe : configuration.recipes) {
    for (const ViewSettings& view : recipe.recipe.views) publish(view, true);
  }
  for (const CameraSettings& camera : configuration.cameras) {
    settings.cameras[camera.name] = camera.encoding;
  }
  return settings;
}

/// What ends or restarts goes to the one thread that waits for it.
sigset_t block_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

/// Waits for a signal; a restart with files that would not start is refused here, while all goes
/// on. True: start again.
bool wait_for_end(const sigset_t& signals, const std::filesystem::path& file) {
  while (true) {
    int signal = 0;
    sigwait(&signals, &signal);
    if (signal != SIGHUP) {
      log_line(LogLevel::Info, "ended by signal " + std::to_string(signal));
      return false;
    }
    const auto checked = load_configuration(file).and_then(check_plans);
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

/// Until a signal. True: to be started again.
Result<bool> run(const Configuration& configuration, const sigset_t& signals,
                 const std::filesystem::path& file) {
  HealthSampler health([board = std::make_shared<BoardHealth>(health_sources(configuration))] {
    return board->read();
  });
  std::optional<Pipeline> pipeline;  // outlives the lines, which trigger its cameras
  auto lines = Lines::open(configuration.lines);
  if (!lines) return tl::unexpected(lines.error());
  auto plan = assemble(configuration, **lines);
  if (!plan) return tl::unexpected(plan.error());
  plan->health = [&health](hal::TimePoint now) { return health.latest(now); };
  pipeline.emplace(std::move(*plan));
  std::optional<SnapshotSink> snapshots;
  if (configuration.snapshot) snapshots.emplace(*configuration.snapshot);
  const Receivers receivers{*pipeline, **lines, snapshots ? &*snapshots : nullptr,
                            [] { ::kill(::getpid(), SIGHUP); }};
  const auto handler = [&](const Command& command) { return dispatch(command, receivers); };
  const auto views = view_names(configuration);
  ConsoleSink console(configuration.console, names(configuration.cameras), views, std::cout);
  DdsSink dds(dds_settings(configuration), status_names(configuration), handler);
  ModbusSink modbus(configuration.modbus, handler);
  std::vector<Sink*> sinks{lines->get()};
  if (configuration.dds.enabled) sinks.push_back(&dds);
  if (configuration.modbus.enabled) sinks.push_back(&modbus);
  if (configuration.console.enabled) sinks.push_back(&console);
  if (snapshots) sinks.push_back(&*snapshots);
  for (Sink* sink : sinks) {
    if (auto started = sink->start(); !started) return tl::unexpected(started.error());
  }
  health.start();
  if (auto started = pipeline->start(sinks); !started) return tl::unexpected(started.error());
  log_line(LogLevel::Info, "runs with " + std::to_string(configuration.cameras.size()) +
                               " cameras, " + std::to_string(views.size()) + " views and " +
                               std::to_string(configuration.recipes.size()) +
                               " recipes, remap kernel " +
                               std::string(remap::default_kernel().name));
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
  const auto configuration = load_configuration(*arguments->config);
  const auto kernel = remap::requested_kernel();
  Result<> result;
  if (!configuration) {
    result = tl::unexpected(configuration.error());
  } else if (!kernel) {
    result = tl::unexpected(kernel.error());
  } else if (arguments->check) {
    result = check_plans(*configuration);
  } else {
    result = run(*configuration, signals, *arguments->config).and_then([&](bool restarts) {
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
