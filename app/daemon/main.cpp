#include <getopt.h>
#include <pthread.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "app/console/console_sink.h"
#include "app/daemon/assemble.h"
#include "app/daemon/lines.h"
#include "app/dds/dds_sink.h"
#include "app/log.h"
#include "app/modbus/modbus_sink.h"
#include "app/version.h"
#include "proc/remap/kernel.h"

namespace orbwatch::app {
namespace {

constexpr const char* kHelp =
    "Usage: orbwatchd --config FILE [--check]\n"
    "\n"
    "Turns pictures of a mirror ball into views, measures the process in them and reports over\n"
    "DDS and Modbus. Runs until SIGTERM or Ctrl-C.\n"
    "\n"
    "  --config FILE  cameras, views and interfaces (TOML), and the rig file that it names;\n"
    "                 `orbwatch describe config` and `orbwatch describe rig` print the manuals\n"
    "  --check        read and check both files, then exit\n"
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

/// SIGTERM and SIGINT go to the one thread that waits for them.
sigset_t block_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

Result<> run(const Configuration& configuration, const sigset_t& end_signals) {
  std::optional<Pipeline> pipeline;  // outlives the lines, which trigger its cameras
  auto lines = Lines::open(configuration.lines);
  if (!lines) return tl::unexpected(lines.error());
  auto plan = assemble(configuration, **lines);
  if (!plan) return tl::unexpected(plan.error());
  pipeline.emplace(std::move(*plan));
  ConsoleSink console(configuration.console, names(configuration.cameras),
                      names(configuration.views), std::cout);
  DdsSink dds(configuration.dds, names(configuration.views));
  ModbusSink modbus(configuration.modbus, [&pipeline, &lines](const Command& command) {
    return command.code == CommandCode::Pulse ? (*lines)->command(command)
                                              : pipeline->command(command);
  });
  std::vector<Sink*> sinks;
  if (configuration.dds.enabled) sinks.push_back(&dds);
  if (configuration.modbus.enabled) sinks.push_back(&modbus);
  if (configuration.console.enabled) sinks.push_back(&console);
  if (!configuration.lines.empty()) sinks.push_back(lines->get());
  for (Sink* sink : sinks) {
    if (auto started = sink->start(); !started) return started;
  }
  if (auto started = pipeline->start(sinks); !started) return started;
  log_line(LogLevel::Info, "runs with " + std::to_string(configuration.cameras.size()) +
                               " cameras and " + std::to_string(configuration.views.size()) +
                               " views, remap kernel " + std::string(remap::default_kernel().name));
  int signal = 0;
  sigwait(&end_signals, &signal);
  pipeline->stop();
  for (Sink* sink : sinks) sink->stop();
  log_line(LogLevel::Info, "ended by signal " + std::to_string(signal));
  return {};
}

int main(int argc, char** argv) {
  int exit_code = 0;
  const auto arguments = parse(argc, argv, exit_code);
  if (!arguments) return exit_code;
  const sigset_t end_signals = block_signals();
  const auto configuration = load_configuration(*arguments->config);
  const auto kernel = remap::requested_kernel();
  Result<> result;
  if (!configuration) {
    result = tl::unexpected(configuration.error());
  } else if (!kernel) {
    result = tl::unexpected(kernel.error());
  } else if (!arguments->check) {
    result = run(*configuration, end_signals);
  }
  if (result) return 0;
  log_line(LogLevel::Error, result.error().message);
  return 1;
}

}  // namespace
}  // namespace orbwatch::app

int main(int argc, char** argv) { return orbwatch::app::main(argc, argv); }
