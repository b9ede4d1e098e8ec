// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <iostream>

#include "app/cli/bench/bench_run.h"
#include "app/cli/bench/bench_site.h"
#include "app/cli/command.h"
#include "app/cli/options/options.h"
#include "app/daemon/site/site_check.h"
#include "app/files/runtime/site_file.h"

namespace orbwatch::app::cli {
namespace {

constexpr double kShortest = 1, kLongest = 3600;  // s

constexpr const char* kJson =
    "\n"
    "--json prints one object: fits, used (share of what the computer can do), verdict,\n"
    "seconds, wanted_rate (frame sets per second), frame_sets, overruns, cores, realtime, "
    "memory_locked,\n"
    "busy {p50_ms, p99_ms}, stages [{name, p50_ms, p99_ms, mean_ms}], cameras [{name, format, "
    "dropped}],\n"
    "views [{name, width, height, published, skipped, latency {p50_ms, p99_ms}}], threads [{id, "
    "name,\n"
    "load (of one core, 0 to 1)}], memory_mib {resident, peak, anonymous, file, shared, locked}.\n";

struct BenchOptions {
  std::filesystem::path config;
  BenchSettings run;
  bool simulated = false;
  bool json = false;
};

std::function<Result<>(const std::string&)> seconds_option(double& target) {
  return [&target](const std::string& value) {
    return parse_number("seconds", value).and_then([&](double seconds) -> Result<> {
      if (!(seconds >= kShortest && seconds <= kLongest)) {
        return fail("--seconds is " + value + "; it must be from 1 to 3600");
      }
      target = seconds;
      return {};
    });
  };
}

std::vector<Option> declare(BenchOptions& o) {
  return {
      {"config", 'c', "FILE", "that of orbwatchd (default: as orbwatchd)", text_option(o.config)},
      {"seconds", 0, "N", "to measure, 1 to 3600 (default 10)", seconds_option(o.run.seconds)},
      {"simulated", 0, "", "test patterns instead of the cameras, in their formats",
       flag_option(o.simulated)},
      {"json", 0, "", "for programs", flag_option(o.json)}};
}

Result<std::string> bench(const BenchOptions& o) {
  auto site = files::resolve(files::site_file(o.config));
  if (!site) return tl::unexpected(site.error());
  if (auto keys = daemon::check_keys(*site, Dates::Ignored); !keys)
    return tl::unexpected(keys.error());
  silence_console(*site);
  std::vector<std::string> notes;
  if (o.simulated) notes = simulate_cameras(*site);
  Progress progress;
  auto figures = run_bench(*site, notes, o.run, {cancelled_by_signal(), progress});
  if (!figures) return tl::unexpected(figures.error());
  const Verdict verdict = judge(*figures);
  std::string text = o.json ? bench_json(*figures, verdict) : bench_text(*figures, verdict);
  if (verdict.fits) return text;
  std::cout << text << std::flush;
  return fail(verdict.sentence);
}

}  // namespace

CliResult<std::string> bench_command(const Arguments& arguments) {
  BenchOptions o;
  return run_command(
      arguments,
      {.usage = "Usage: orbwatch bench --config FILE [options]\n\n"
                "Runs a configuration as orbwatchd does, and prints what it takes of this "
                "computer:\nprocessor time of each stage per frame set, load of each thread, "
                "latency, memory; and\nin one line whether it fits the rate. Exit status 1: it "
                "does not.\n\n",
       .options = declare(o),
       .notes = "\nStop orbwatchd first: it has the cameras. What nobody reads is not encoded: let "
                "the\ncontroller, or `orbwatch subscribe`, read the topics that it will read. "
                "With --simulated,\nlines are simulated, Modbus is not served, and the topics "
                "are those of \"<prefix>_bench\". Recordings and snapshots go to a "
                "temporary\nfolder.\n" +
                std::string(kJson)},
      [&](const auto&) { return bench(o); });
}

}  // namespace orbwatch::app::cli
