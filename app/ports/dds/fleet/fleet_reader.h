#pragma once

#include "app/model/fleet.h"
#include "app/ports/dds/topics/topic_reader.h"

namespace orbwatch::app {

/// Hears the appliances of a domain, and sees their thumbnails while somebody looks. Everything is
/// checked as soon as it arrives, on Cyclone's threads: nothing waits in queues that a sender could
/// fill. Thread rule: one owner.
class FleetReader {
 public:
  /// `fleet` outlives it.
  explicit FleetReader(Fleet& fleet);
  ~FleetReader() { close(); }
  FleetReader(const FleetReader&) = delete;  // Cyclone DDS keeps its address
  FleetReader& operator=(const FleetReader&) = delete;

  /// Error: DDS refuses.
  Result<> open(const Entity& participant);
  void close();

  /// Begins or ends the reading of thumbnails, which makes the appliances send them. Error: DDS
  /// refuses.
  Result<> read_thumbnails(const Entity& participant, bool wanted);

 private:
  static void on_notices(dds_entity_t reader, void* self);
  static void on_thumbnails(dds_entity_t reader, void* self);

  Fleet& fleet_;
  TopicReader notices_;
  TopicReader thumbnails_;
};

/// The id in Fleet of a participant. Error: DDS refuses.
Result<std::string> appliance_id(dds_entity_t participant);

}  // namespace orbwatch::app
