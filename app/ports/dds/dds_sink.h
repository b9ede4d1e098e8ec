// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/model/command/command.h"
#include "app/model/sink/sink.h"
#include "app/ports/dds/commands/command_service.h"
#include "app/ports/dds/dds_settings.h"
#include "app/ports/dds/fleet/fleet_member.h"
#include "app/ports/dds/machine/machine_state_reader.h"
#include "app/ports/dds/participant/network_addresses.h"
#include "app/ports/dds/participant/participant.h"
#include "app/ports/dds/pictures/camera_topics.h"
#include "app/ports/dds/pictures/info_topic.h"
#include "app/ports/dds/pictures/picture_topic.h"
#include "app/ports/dds/pictures/view_topics.h"
#include "app/ports/dds/ros/ros_node.h"
#include "app/ports/dds/status/dds_statistics.h"
#include "app/ports/dds/status/status_queue.h"
#include "app/ports/dds/status/status_topics.h"
#include "app/ports/dds/topics/type_watch.h"
#include "hal/back_off.h"
#include "hal/thread/bounded_queue.h"
#include "hal/thread/thread.h"

namespace orbwatch::app::dds {

/// Publishes views and cameras' pictures as sensor_msgs/Image and CompressedImage, the status as
/// ProcessState and diagnostics, and events, under ROS 2 names as a ROS 2 node, and executes
/// commands; see topic_names.h. All samples of a frame set have the same UTC stamp, so that readers
/// can pair images and state exactly. Pictures are encoded and written on shared threads, commands
/// are executed on a thread of their own; everything else is published on the sink's thread, which
/// also joins the domain with retries, and rejoins when the addresses of its interfaces change.
/// Thread rule: as Sink; statistics() is thread-safe; start may run while views are passed to
/// accept().
class DdsSink final : public Sink {
 public:
  using Addresses = std::function<std::optional<std::vector<NetworkAddress>>()>;

  /// `names` in the order of View::index and of FrameSet::frames; the name of a view or camera is a
  /// topic part and the frame_id of its images. `handler` executes commands, on a thread of the
  /// sink; without a handler there is no command topic. `addresses` are checked once a second.
  /// `identity` and `fleet`: see FleetMember. `views` and `cameras` are in the order of `names`;
  /// missing ones are published with the defaults. `machine` gets the states of the machine if DDS
  /// is their source.
  DdsSink(DdsSettings settings, StatusNames names, CommandHandler handler,
          Addresses addresses = network_addresses,
          std::shared_ptr<CommandRecord> record = std::make_shared<CommandRecord>(),
          const std::shared_ptr<hal::SharedThreads>& threads = hal::SharedThreads::alone(),
          ApplianceIdentity identity = {}, std::shared_ptr<Fleet> fleet = nullptr,
          std::vector<PublishedView> views = {}, std::vector<PublishedCamera> cameras = {},
          MachinePath machine = {});
  ~DdsSink() override;

  /// Starts the sink's thread. Does nothing when disabled or running. Errors: an invalid domain or
  /// name, or a duplicate name. A missing network is not an error.
  Result<> start() override;
  void stop() override;
  /// Returns whether the sink has joined the domain.
  bool works() const override { return joined_; }
  std::chrono::nanoseconds cpu_time() const override;

  /// Table of the topics with their readers.
  std::vector<InterfaceTable> tables() const override;
  std::vector<InterfaceMetric> metrics() const override;

  void accept_frames(const hal::FrameSet& set) override;
  PictureNeeds needs(std::size_t view, hal::TimePoint stamp) override;
  KeptViews keeps() const override;
  void accept(const ViewPtr& view) override;
  void accept(const Status& status) override;
  void accept_event(const AlarmNotice& notice) override;

  DdsStatistics statistics() const;

 private:
  /// Every alarm may be acknowledged and change in one frame set; the queue holds the events of
  /// four frame sets.
  static constexpr std::size_t kMaxNotices = 8 * signals::kMaxAlarms;

  Result<> check() const;
  std::vector<const TopicWriter*> writers() const;
  std::vector<const TopicReader*> readers() const;
  Result<> join();
  Result<> open_machine();
  Result<> announce_node();
  Result<> watch_types();
  void leave();
  void keep_joined();
  void run();
  void publish(const StampedStatus& status);
  /// Converts a stamp to UTC, equal results for equal stamps; on the pipeline's thread.
  TimeMessage utc(hal::TimePoint stamp);

  const DdsSettings settings_;
  const StatusNames names_;
  const std::shared_ptr<hal::SharedThreads> threads_;
  const Addresses addresses_;

  // Shared by the pipeline's thread and others.
  std::vector<std::unique_ptr<ViewTopics>> views_;
  std::vector<std::unique_ptr<CameraTopics>> cameras_;
  PictureTopics selected_;
  InfoTopic selected_info_;
  StatusQueue statuses_;
  hal::BoundedQueue<StampedNotice, kMaxNotices> notices_;
  std::atomic<bool> running_{false};
  std::atomic<std::uint64_t> unknown_views_{0};
  std::atomic<std::uint64_t> joins_{0};
  std::atomic<std::uint64_t> mistyped_{0};

  // Used by the pipeline's thread only.
  hal::TimePoint stamp_;
  std::chrono::system_clock::time_point utc_;
  std::size_t selected_view_ = 0;

  // Used by the sink's thread while it runs, else by the owner.
  Participant participant_;
  std::atomic<bool> joined_{false};
  std::vector<NetworkAddress> tried_addresses_;  ///< addresses at the newest attempt to join
  InterfaceWatch interfaces_;
  hal::TimePoint next_check_;  ///< time of the next check of the addresses
  /// Time of the next attempt to join, unless the addresses change before.
  hal::TimePoint next_try_;
  hal::BackOff back_off_;
  std::string refusal_;  ///< reason why the newest attempt failed; empty: it succeeded
  StatusTopics status_topics_;
  FleetMember fleet_;
  DiscoveryInfo discovery_;
  TypeWatch type_watch_;
  hal::Thread thread_;

  const bool takes_commands_;
  const std::shared_ptr<CommandRecord> record_;
  CommandService commands_;
  std::optional<MachineStateReader> machine_;  ///< set if this is the source of states
};

}  // namespace orbwatch::app::dds
