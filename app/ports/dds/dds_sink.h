#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/model/command.h"
#include "app/model/sink.h"
#include "app/ports/dds/commands/bounded_queue.h"
#include "app/ports/dds/commands/command_service.h"
#include "app/ports/dds/dds_settings.h"
#include "app/ports/dds/fleet/fleet_member.h"
#include "app/ports/dds/participant/network_addresses.h"
#include "app/ports/dds/participant/participant.h"
#include "app/ports/dds/pictures/camera_topics.h"
#include "app/ports/dds/pictures/info_topic.h"
#include "app/ports/dds/pictures/picture_topic.h"
#include "app/ports/dds/pictures/view_topics.h"
#include "app/ports/dds/ros/ros_node.h"
#include "app/ports/dds/status/dds_statistics.h"
#include "app/ports/dds/status/status_topics.h"
#include "app/ports/dds/topics/type_watch.h"
#include "hal/back_off.h"
#include "hal/thread/mailbox.h"
#include "hal/thread/thread.h"

namespace orbwatch::app {

/// Publishes views and cameras' pictures as sensor_msgs/Image and CompressedImage, the status as
/// ProcessState and diagnostics, and events, under ROS 2 names as a ROS 2 node, and carries
/// commands out; see topic_names.h. Everything of a frame set has the same UTC stamp, so that
/// readers can pair images and state exactly. Pictures are encoded and written on shared threads;
/// the rest is published on the sink's, which also carries commands out, joins the domain, retries
/// until it succeeds, and rejoins when the addresses of its interfaces change. Thread rule: as
/// Sink; statistics() is thread-safe; start may run while views are passed to accept().
class DdsSink final : public Sink {
 public:
  using Addresses = std::function<std::optional<std::vector<NetworkAddress>>()>;

  /// `names` in the order of View::index and of FrameSet::frames; the name of a view or camera is a
  /// topic part and the frame_id of its images. `handler` carries commands out, on a thread of the
  /// sink; without one there is no command topic. `addresses` are checked once a second.
  /// `identity` and `fleet` as FleetMember. `views` and `cameras` by place in `names`; those that
  /// are missing are published as default ones.
  DdsSink(DdsSettings settings, StatusNames names, CommandHandler handler,
          Addresses addresses = network_addresses,
          std::shared_ptr<CommandRecord> record = std::make_shared<CommandRecord>(),
          const std::shared_ptr<hal::SharedThreads>& threads = hal::SharedThreads::alone(),
          ApplianceIdentity identity = {}, std::shared_ptr<Fleet> fleet = nullptr,
          std::vector<PublishedView> views = {}, std::vector<PublishedCamera> cameras = {});
  ~DdsSink() override;

  /// Starts the sink's thread. Does nothing when disabled or running. Errors: a domain or name that
  /// is not allowed, or a duplicate name. A missing network is no error.
  Result<> start() override;
  void stop() override;
  /// Whether it is in the domain.
  bool works() const override { return joined_; }
  std::chrono::nanoseconds cpu_time() const override;

  /// Topics with their readers.
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
  /// Every alarm may be acknowledged and change in one frame set: room for four of those.
  static constexpr std::size_t kMaxNotices = 8 * signals::kMaxAlarms;

  Result<> check() const;
  std::vector<const TopicWriter*> writers() const;
  Result<> join();
  Result<> announce_node();
  Result<> watch_types();
  void leave();
  void keep_joined();
  void run();
  /// UTC of a stamp, the same for the same stamp; on the pipeline's thread.
  TimeMessage utc(hal::TimePoint stamp);

  const DdsSettings settings_;
  const StatusNames names_;
  const std::shared_ptr<hal::SharedThreads> threads_;
  const Addresses addresses_;

  // Between the pipeline's thread and others.
  std::vector<std::unique_ptr<ViewTopics>> views_;
  std::vector<std::unique_ptr<CameraTopics>> cameras_;
  PictureTopics selected_;
  InfoTopic selected_info_;
  hal::Mailbox<StampedStatus> status_;
  BoundedQueue<StampedNotice, kMaxNotices> notices_;
  std::atomic<bool> running_{false};
  std::atomic<std::uint64_t> unknown_views_{0};
  std::atomic<std::uint64_t> joins_{0};
  std::atomic<std::uint64_t> mistyped_{0};

  // The pipeline's thread only.
  hal::TimePoint stamp_;
  std::chrono::system_clock::time_point utc_;
  std::size_t selected_view_ = 0;

  // The sink's thread while it runs, else the owner's.
  Participant participant_;
  std::atomic<bool> joined_{false};
  std::vector<NetworkAddress> tried_addresses_;  ///< at the newest attempt to join
  InterfaceWatch interfaces_;
  hal::TimePoint next_check_;  ///< of the addresses
  hal::TimePoint next_try_;    ///< to join, unless the addresses change before
  hal::BackOff back_off_;
  std::string refusal_;  ///< why the newest attempt failed; empty: it succeeded
  StatusTopics status_topics_;
  FleetMember fleet_;
  DiscoveryInfo discovery_;
  TypeWatch type_watch_;
  hal::Thread thread_;

  const bool takes_commands_;
  const std::shared_ptr<CommandRecord> record_;
  CommandService commands_;
};

}  // namespace orbwatch::app
