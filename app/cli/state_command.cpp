// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <iostream>

#include "app/cli/command.h"
#include "app/cli/dds/received_state.h"
#include "app/cli/options/dds_options.h"
#include "app/cli/options/options.h"
#include "app/cli/state_text.h"
#include "app/ports/dds/topics/topic_names.h"
#include "hal/clock.h"

namespace orbwatch::app::cli {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPollPeriod{100};
constexpr milliseconds kTablePeriod{1000};

struct StateOptions {
  int domain = 0;
  std::string prefix = "orbwatch";
  std::optional<dds::SecuritySettings> security;
  milliseconds timeout{5000};
  bool json = false;
  bool follow = false;
};

std::vector<Option> declare(StateOptions& o) {
  return {{"json", 0, "", "for programs, a line per state", flag_option(o.json)},
          {"follow", 'f', "", "each one that arrives, tables once a second", flag_option(o.follow)},
          domain_option(o.domain),
          prefix_option(o.prefix),
          security_option(o.security),
          timeout_option(o.timeout)};
}

void print(const ReceivedState& state, bool json) {
  std::cout << (json ? state_json(state) : state_table(state) + "\n") << std::flush;
}

/// Prints the first state, or all until cancelled; fails when none arrives within the timeout.
Result<> print_states(StateReader& reader, const StateOptions& o,
                      const std::atomic<bool>& cancelled) {
  const milliseconds period = o.follow && !o.json ? kTablePeriod : milliseconds(0);
  auto received = hal::Clock::now();
  auto printed = received - period;
  std::string refusal;
  while (!cancelled) {
    const auto next = reader.next(std::min(kPollPeriod, o.timeout), [&](const auto& state) {
      received = hal::Clock::now();
      if (received - printed < period) return;
      print(state, o.json);
      printed = received;
    });
    if (!next) return tl::unexpected(next.error());
    if (*next && !o.follow) return {};
    if (reader.refusal() != refusal) {
      refusal = reader.refusal();
      std::cerr << "orbwatch: " << refusal << '\n';
    }
    if (hal::Clock::now() - received >= o.timeout) {
      return fail("DDS: nothing on " + dds::process_state_topic(o.prefix) +
                  "; does orbwatchd run in this domain?");
    }
  }
  return o.follow ? Result<>() : fail("DDS: cancelled before a state arrived");
}

}  // namespace

CliResult<std::string> state_command(const Arguments& arguments) {
  StateOptions o;
  return run_command(
      arguments,
      {.usage = "Usage: orbwatch state [options]\n\n"
                "Prints the newest process state of a running orbwatchd, received over DDS.\n\n",
       .options = declare(o),
       .notes = "\n--json prints one object on a line: stamp (UTC), frame_set, trigger, result, "
                "recipe,\nconfiguration_checksum, system_state, heartbeat; system, health and "
                "commands {figures};\ncameras, views, regions, alarms, stages [{name, figures}]. A "
                "code has its number, and as NAME_text\nits "
                "meaning; what is not valid is null. Units are those of the table without it.\n"},
      [&](const auto&) {
        StateReader reader(o.prefix);
        return reader.open(o.domain, o.security)
            .and_then([&] { return print_states(reader, o, cancelled_by_signal()); })
            .map([] { return std::string(); });
      });
}

}  // namespace orbwatch::app::cli
