// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "app/ports/modbus/modbus_sink.h"
#include "hal/clock.h"
#include "tests/app/ports/modbus/abuses.h"
#include "tests/app/ports/modbus/clients.h"

/// Delay of a PLC's answers while other clients abuse the server.
namespace orbwatch::app {
namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr double kAim = 50;  // ms, p99
constexpr int kRegisters = 96;

/// Times of consecutive requests, sorted. Throws when one is not answered.
std::vector<double> request_times(int port, std::chrono::seconds duration) {
  tests::Plc plc(port);
  std::vector<double> times;
  const auto end = hal::Clock::now() + duration;
  for (auto begin = hal::Clock::now(); begin < end;) {
    if (plc.read_input(0, kRegisters) != 0) throw std::runtime_error("a request was not answered");
    const auto now = hal::Clock::now();
    times.push_back(Milliseconds(now - begin).count());
    begin = now;
  }
  std::ranges::sort(times);
  return times;
}

double quantile(const std::vector<double>& sorted, double part) {
  const auto last = static_cast<double>(sorted.size() - 1);
  return sorted[static_cast<std::size_t>(part * last)];
}

/// Measures with a new server for each abuse, so that none is affected by an earlier one. Uses the
/// product's settings, except that the PLC is the writer.
std::vector<double> measured(const orbwatch::tests::Abuse* abuse, std::chrono::seconds duration) {
  ModbusSettings settings;
  settings.address = "127.0.0.1";
  settings.port = 0;
  settings.writers = {"127.0.0.1"};
  ModbusSink sink(settings, tests::accept_all);
  if (const auto started = sink.start(); !started) {
    throw std::runtime_error(started.error().message);
  }
  std::unique_ptr<orbwatch::tests::Abused> abused;
  if (abuse != nullptr) abused = std::make_unique<orbwatch::tests::Abused>(*abuse, sink.port());
  return request_times(sink.port(), duration);
}

/// Prints a row; returns its p99 in ms.
double report(std::string_view name, const std::vector<double>& times, double p99_without) {
  const double p99 = quantile(times, 0.99);
  std::printf("| %s | %zu | %.3f | %.3f | %.3f | %.1f |\n", std::string(name).c_str(), times.size(),
              quantile(times, 0.5), p99, times.back(), p99 / (p99_without > 0 ? p99_without : p99));
  std::fflush(stdout);
  return p99;
}

int run(std::chrono::seconds duration) {
  std::printf(
      "| abuse | requests | p50, ms | p99, ms | longest, ms | p99 / p99 without |\n"
      "|---|---:|---:|---:|---:|---:|\n");
  const double without = report("none", measured(nullptr, duration), 0);
  double worst = without;
  for (const orbwatch::tests::Abuse& abuse : tests::abuses()) {
    worst = std::max(worst, report(abuse.name, measured(&abuse, duration), without));
  }
  if (worst <= kAim) return 0;
  std::fprintf(stderr, "modbus_bench: worst p99 is %.1f ms, the aim is %.0f ms\n", worst, kAim);
  return std::getenv("CI") != nullptr ? 0 : 1;  // times are not evaluated there
}

}  // namespace
}  // namespace orbwatch::app

int main(int argc, char** argv) {
  const int seconds = argc == 2 ? std::atoi(argv[1]) : 0;
  if (seconds < 1) {
    std::fprintf(stderr, "modbus_bench SECONDS: measures each abuse for so long\n");
    return 2;
  }
  try {
    return orbwatch::app::run(std::chrono::seconds(seconds));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "modbus_bench: %s\n", error.what());
    return 1;
  }
}
