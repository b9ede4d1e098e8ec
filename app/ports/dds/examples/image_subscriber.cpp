// SPDX-License-Identifier: Apache-2.0
// Reads one view of orbwatch over DDS and prints a line per picture:
//   image_subscriber [TOPIC [PICTURES]]
// TOPIC: rt/orbwatch/selected/image_raw by default; PICTURES: how many to read, 0 (default): all.
// The domain is ROS_DOMAIN_ID, 0 if unset; network settings come from CYCLONEDDS_URI.

#include <dds/dds.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "app/ports/dds/generated/image.h"

namespace {

using Image = sensor_msgs_msg_dds__Image_;

/// The C API returns a handle, a count, or an error below 0.
dds_entity_t checked(const char* what, dds_return_t code) {
  if (code < 0) throw std::runtime_error(std::string(what) + ": " + dds_strretcode(code));
  return code;
}

/// Best effort and the newest picture only: a slow reader gets fewer, never old ones.
dds_entity_t make_reader(dds_entity_t participant, const char* topic_name) {
  const dds_entity_t topic =
      checked("topic", dds_create_topic(participant, &sensor_msgs_msg_dds__Image__desc, topic_name,
                                        nullptr, nullptr));
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, nullptr);
  dds_delete_qos(qos);
  return checked("reader", reader);
}

void print(const Image& image, const dds_sample_info_t& info) {
  const double age_ms = static_cast<double>(dds_time() - info.source_timestamp) * 1e-6;
  std::printf("%s %ux%u %s, exposed at %d.%09u, %.1f ms after it was written\n",
              image.header.frame_id, image.width, image.height, image.encoding,
              image.header.stamp.sec, image.header.stamp.nanosec, age_ms);
  std::fflush(stdout);
}

/// Waits for data and prints it; returns the number of pictures.
int read(dds_entity_t reader, dds_entity_t wait_set) {
  checked("wait", dds_waitset_wait(wait_set, nullptr, 0, DDS_INFINITY));
  void* sample = nullptr;  // null: DDS loans a sample
  dds_sample_info_t info;
  const dds_return_t count = checked("take", dds_take(reader, &sample, &info, 1, 1));
  if (count == 0) return 0;
  const bool valid = info.valid_data;  // false if only the writer's state changed
  if (valid) print(*static_cast<const Image*>(sample), info);
  checked("return", dds_return_loan(reader, &sample, count));
  return valid ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) try {
  const char* topic = argc > 1 ? argv[1] : "rt/orbwatch/selected/image_raw";
  const int wanted = argc > 2 ? std::atoi(argv[2]) : 0;
  const char* domain = std::getenv("ROS_DOMAIN_ID");
  const dds_entity_t participant =
      checked("participant",
              dds_create_participant(domain == nullptr ? 0 : std::atoi(domain), nullptr, nullptr));
  const dds_entity_t reader = make_reader(participant, topic);
  const dds_entity_t wait_set = checked("wait set", dds_create_waitset(participant));
  const dds_entity_t data = checked("condition", dds_create_readcondition(reader, DDS_ANY_STATE));
  checked("wait set", dds_waitset_attach(wait_set, data, 0));
  for (int seen = 0; wanted == 0 || seen < wanted;) seen += read(reader, wait_set);
  dds_delete(participant);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "image_subscriber: %s\n", error.what());
  return 1;
}
