#include <iostream>

#include "app/cli/cancelled.h"
#include "app/cli/command.h"
#include "app/cli/dds/subscriber.h"
#include "app/cli/options/dds_options.h"
#include "app/cli/options/options.h"

namespace orbwatch::app {
namespace {

std::vector<Option> declare(SubscribeOptions& o, bool& help) {
  return {
      {"topic", 0, "TOPIC",
       "to read, with or without rt/; may be repeated\n(default: the selected view and the process "
       "state)",
       [&o](const std::string& v) -> Result<> {
         o.topics.push_back(v);
         return {};
       }},
      domain_option(o.domain),
      prefix_option(o.prefix),
      security_option(o.security),
      {"save", 0, "DIR", "save the newest image of each topic as PNG", text_option(o.save)},
      {"seconds", 0, "N", "end after this time (default: Ctrl-C)",
       number_option("seconds", o.seconds)},
      {"stats", 0, "", "print rate, size, latency and gaps every second", flag_option(o.stats)},
      {"each", 0, "", "print a line for each sample", flag_option(o.each)},
      {"help", 'h', "", "this text", flag_option(help)},
  };
}

}  // namespace

Result<> subscribe_command(const std::vector<std::string>& arguments) {
  SubscribeOptions o;
  bool help = false;
  const std::vector<Option> options = declare(o, help);
  const auto rest = parse_options(arguments, options);
  if (!rest) return tl::unexpected(rest.error());
  if (!rest->empty()) return fail("unexpected argument " + rest->front() + "; see --help");
  if (help) {
    std::cout << "Usage: orbwatch subscribe [options]\n\n"
                 "Reads views and process state over DDS. Fails when a topic brought nothing.\n\n"
              << options_help(options);
    return {};
  }
  const auto report = subscribe(o, cancelled_by_signal(), std::cout);
  if (!report) return tl::unexpected(report.error());
  for (const TopicReport& topic : report->topics) {
    if (topic.received == 0)
      return fail(topic.topic + ": nothing was received; does orbwatchd run in this domain?");
  }
  return {};
}

}  // namespace orbwatch::app
