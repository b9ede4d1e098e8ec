#include <atomic>
#include <csignal>
#include <iostream>

#include "app/cli/command.h"
#include "app/cli/options.h"
#include "app/dds/subscriber.h"

namespace orbwatch::app {
namespace {

std::atomic<bool> cancelled{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

void cancel(int) { cancelled = true; }

std::vector<Option> declare(SubscribeOptions& o, bool& help) {
  return {
      {"topic", 0, "TOPIC",
       "to read, with or without rt/; may be repeated\n(default: the selected view and the process "
       "state)",
       [&o](const std::string& v) -> Result<> {
         o.topics.push_back(v);
         return {};
       }},
      {"domain", 0, "N", "DDS domain, 0 to 230 (default 0)",
       [&o](const std::string& v) {
         return parse_whole("domain", v).and_then([&o](int n) -> Result<> {
           o.domain = n;
           if (n >= 0 && n <= 230) return {};
           return fail("--domain is " + std::to_string(n) + "; it must be 0 to 230");
         });
       }},
      {"prefix", 0, "NAME",
       "of the default topics, as in the configuration's\n[dds] (default orbwatch)",
       text_option(o.prefix)},
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
  std::signal(SIGINT, cancel);
  std::signal(SIGTERM, cancel);
  const auto report = subscribe(o, cancelled, std::cout);
  if (!report) return tl::unexpected(report.error());
  for (const TopicReport& topic : report->topics) {
    if (topic.received == 0)
      return fail(topic.topic + ": nothing was received; does orbwatchd run in this domain?");
  }
  return {};
}

}  // namespace orbwatch::app
