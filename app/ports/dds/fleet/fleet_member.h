#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/model/fleet.h"
#include "app/ports/dds/fleet/fleet_reader.h"
#include "app/ports/dds/pictures/picture_topic.h"

namespace orbwatch::app {

/// An appliance among those of its domain: says what it is once a second, shows a thumbnail every
/// few seconds to those who look, and hears the others. Without a right to that, as keys that were
/// made before it existed have none, it does nothing and says so in the log.
/// Thread rule: wants and accept by the pipeline's thread; topics and writers' statistics by any;
/// the rest by one owner.
class FleetMember {
 public:
  /// `fleet`: who is heard; null: nobody wants to know.
  FleetMember(ApplianceIdentity identity, std::shared_ptr<Fleet> fleet,
              const std::shared_ptr<hal::SharedThreads>& threads);

  /// `participant` stays until close(). `address`: where DDS reaches this computer, for a page that
  /// listens on all addresses.
  void open(const Entity& participant, const std::string& address);
  void close();

  /// To be called with every status.
  void publish(const StatusReport& report);

  PictureNeeds needs(const TimeMessage& stamp) const;
  /// A picture that serves what needs() told.
  void accept(const StampedPicture& picture) { thumbnails_.accept(picture); }

  /// Those that are open.
  std::vector<const TopicWriter*> writers() const;
  void report(std::vector<TopicStatistics>& topics) const;
  std::chrono::nanoseconds cpu_time() const { return thumbnails_.cpu_time(); }

 private:
  Result<> open_all(const Entity& participant);

  const ApplianceIdentity identity_;
  ApplianceIdentity present_;  ///< with the present address
  const std::shared_ptr<Fleet> fleet_;
  std::optional<FleetReader> reader_;
  const Entity* participant_ = nullptr;  ///< from open() to close()
  TopicWriter notices_;
  PictureTopic thumbnails_;
  bool is_open_ = false;
  hal::TimePoint next_;
};

}  // namespace orbwatch::app
