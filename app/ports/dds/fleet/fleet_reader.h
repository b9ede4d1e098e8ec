// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/model/fleet/fleet.h"
#include "app/ports/dds/topics/topic_reader.h"

namespace orbwatch::app::dds {

/// Receives the announcements of the appliances of a domain, and their thumbnails while there are
/// viewers. Samples are checked on arrival, on Cyclone's threads, so that a sender cannot fill
/// queues. Thread rule: one owner.
class FleetReader {
 public:
  /// `fleet` outlives the reader.
  explicit FleetReader(Fleet& fleet);
  ~FleetReader() { close(); }
  FleetReader(const FleetReader&) = delete;  // Cyclone DDS keeps its address
  FleetReader& operator=(const FleetReader&) = delete;

  /// Error: a failure of DDS.
  Result<> open(const Entity& participant);
  void close();

  /// Starts or stops reading thumbnails, which makes the appliances send them. Error: a failure of
  /// DDS.
  Result<> read_thumbnails(const Entity& participant, bool wanted);

 private:
  static void on_notices(dds_entity_t reader, void* self);
  static void on_thumbnails(dds_entity_t reader, void* self);

  Fleet& fleet_;
  TopicReader notices_;
  TopicReader thumbnails_;
};

/// Id of a participant in Fleet. Error: a failure of DDS.
Result<std::string> appliance_id(dds_entity_t participant);

}  // namespace orbwatch::app::dds
