// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/model/fleet/fleet.h"
#include "app/ports/dds/fleet/fleet_reader.h"
#include "app/ports/dds/pictures/picture_topic.h"

namespace orbwatch::app::dds {

/// Membership of the appliance in its domain's fleet: announces itself once a second, publishes a
/// thumbnail every few seconds while it has viewers, and receives the announcements of the others.
/// Without permission, as with keys of earlier versions, it does nothing and logs so.
/// Thread rule: needs and accept by the pipeline's thread; topics and writers' statistics by any;
/// the rest by one owner.
class FleetMember {
 public:
  /// `fleet`: receives the other appliances; null: they are not read.
  FleetMember(ApplianceIdentity identity, std::shared_ptr<Fleet> fleet,
              const std::shared_ptr<hal::SharedThreads>& threads);

  /// `participant` must live until close(). `address`: this computer's address in the domain, for a
  /// page that listens on all addresses.
  void open(const Entity& participant, const std::string& address);
  void close();

  /// Announces the appliance; to be called with every status.
  void publish(const StatusReport& report);

  /// The forms in which readers need the picture of this moment; for the next accept().
  PictureNeeds needs(const TimeMessage& stamp);
  /// Accepts a picture that serves the result of needs(): without needs it may be empty.
  void accept(const StampedPicture& picture) { thumbnails_.accept(picture, asked_); }

  /// The open writers.
  std::vector<const TopicWriter*> writers() const;
  void report(std::vector<TopicStatistics>& topics) const;
  std::chrono::nanoseconds cpu_time() const { return thumbnails_.cpu_time(); }

 private:
  Result<> open_all(const Entity& participant);

  const ApplianceIdentity identity_;
  ApplianceIdentity present_;  ///< identity with the present address
  const std::shared_ptr<Fleet> fleet_;
  std::optional<FleetReader> reader_;
  const Entity* participant_ = nullptr;  ///< set from open() to close()
  TopicWriter notices_;
  PictureTopic thumbnails_;
  bool asked_ = false;  ///< set by needs(); used by the pipeline's thread only
  bool is_open_ = false;
  hal::TimePoint next_;
};

}  // namespace orbwatch::app::dds
