// SPDX-License-Identifier: Apache-2.0
#include <iostream>

#include "app/cli/command.h"
#include "app/cli/dds/subscriber.h"
#include "app/cli/options/dds_options.h"
#include "app/cli/options/options.h"

namespace orbwatch::app::cli {
namespace {

std::vector<Option> declare(SubscribeOptions& o) {
  return {
      {"topic", 0, "TOPIC",
       "to read, with or without rt/; may be repeated\n(default: the selected view and the process "
       "state)",
       list_option(o.topics)},
      domain_option(o.domain),
      prefix_option(o.prefix),
      security_option(o.security),
      {"save", 0, "DIR", "save the newest image of each topic as PNG", text_option(o.save)},
      {"seconds", 0, "N", "end after this time (default: Ctrl-C)",
       number_option("seconds", o.seconds)},
      {"count", 0, "N", "end when each topic has brought so many (default: no end)",
       number_option("count", o.count)},
      {"stats", 0, "", "print rate, size, latency and gaps every second", flag_option(o.stats)},
      {"each", 0, "", "print a line for each sample", flag_option(o.each)},
      {"json", 0, "", "these lines for programs", flag_option(o.json)},
  };
}

constexpr const char* kSubscribeNotes =
    "\n"
    "--json prints one object on each line. --stats: topic, seconds (that the figures are of),\n"
    "samples, rate (1/s), longest_gap_ms (between two samples), since_write_ms and\n"
    "since_exposure_ms (mean latencies), newest (content; these are null without a sample), lost,\n"
    "refused (since the beginning) and refusal (why the newest one was; empty: none was). --each:\n"
    "topic, content, since_exposure_ms.\n";

/// Reads topics and prints while reading.
CliResult<std::string> read_topics(const SubscribeOptions& o) {
  if (o.json && !o.stats && !o.each) return usage_error("--json needs --stats or --each");
  const auto reports = subscribe(o, cancelled_by_signal(), std::cout);
  if (!reports) return tl::unexpected(reports.error());
  for (const TopicReport& report : *reports) {
    if (report.received == 0)
      return fail(report.topic + ": nothing was received; does orbwatchd run in this domain?");
  }
  return {};
}

}  // namespace

CliResult<std::string> subscribe_command(const Arguments& arguments) {
  SubscribeOptions o;
  return run_command(
      arguments,
      {.usage = "Usage: orbwatch subscribe [options]\n\n"
                "Reads views and process state over DDS. Fails when a topic brought nothing, and\n"
                "at once when its type is one that cannot be read.\n\n",
       .options = declare(o),
       .notes = kSubscribeNotes},
      [&](const auto&) { return read_topics(o); });
}

}  // namespace orbwatch::app::cli
