// SPDX-License-Identifier: Apache-2.0
// Sends the states of a machine to orbwatch over DDS, here those of a tool on a circle:
//   machine_publisher [TOPIC [STATES]]
// TOPIC: rt/orbwatch/machine_state by default; STATES: how many to send, 0 (default): without end.
// orbwatch takes them with source = "dds" under [machine] in its site file.
// The domain is ROS_DOMAIN_ID, 0 if unset; network settings come from CYCLONEDDS_URI.

#include <dds/dds.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <stdexcept>
#include <string>
#include <thread>

#include "app/ports/dds/generated/machine_state.h"

namespace {

using State = orbwatch_msgs_msg_dds__MachineState_;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPeriod{4};

/// The C API returns a handle, a count, or an error below 0.
dds_entity_t checked(const char* what, dds_return_t code) {
  if (code < 0) throw std::runtime_error(std::string(what) + ": " + dds_strretcode(code));
  return code;
}

/// Best effort: a state that is lost is followed by the next one 4 ms later.
dds_entity_t make_writer(dds_entity_t participant, const char* topic_name) {
  const dds_entity_t topic =
      checked("topic", dds_create_topic(participant, &orbwatch_msgs_msg_dds__MachineState__desc,
                                        topic_name, nullptr, nullptr));
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  const dds_entity_t writer = dds_create_writer(participant, topic, qos, nullptr);
  dds_delete_qos(qos);
  return checked("writer", writer);
}

/// State of the axes at `moment`: a circle of 40 mm in 12 s. A controller reads its axes and its
/// clock in the same cycle.
State state_at(Clock::time_point moment, std::uint32_t number) {
  constexpr double kRadius = 40, kLap = 12;  // mm, s
  State state{};
  state.number = number;
  state.clock = std::chrono::duration<double>(moment.time_since_epoch()).count();
  std::snprintf(state.part, sizeof state.part, "example");
  const double laps = state.clock / kLap, angle = 2 * std::numbers::pi * laps;
  state.program = 1;
  state.layer = std::floor(laps);
  state.track = 1;
  state.x = kRadius * std::cos(angle);
  state.y = kRadius * std::sin(angle);
  state.feed = 60 * 2 * std::numbers::pi * kRadius / kLap;
  state.laser_power = 1800;
  state.powder_flow = std::nan("");  // not known
  state.laser_on = state.program_running = 1;
  return state;
}

}  // namespace

int main(int argc, char** argv) try {
  const char* topic = argc > 1 ? argv[1] : "rt/orbwatch/machine_state";
  const int wanted = argc > 2 ? std::atoi(argv[2]) : 0;
  const char* domain = std::getenv("ROS_DOMAIN_ID");
  const dds_entity_t participant =
      checked("participant",
              dds_create_participant(domain == nullptr ? 0 : std::atoi(domain), nullptr, nullptr));
  const dds_entity_t writer = make_writer(participant, topic);
  Clock::time_point due = Clock::now();
  for (int sent = 0; wanted == 0 || sent < wanted; due += kPeriod) {
    std::this_thread::sleep_until(due);
    const State state = state_at(due, static_cast<std::uint32_t>(++sent));
    checked("write", dds_write(writer, &state));
  }
  dds_delete(participant);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "machine_publisher: %s\n", error.what());
  return 1;
}
