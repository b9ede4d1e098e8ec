#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/commands.h"
#include "app/dds/bounded_queue.h"
#include "app/dds/command_service.h"
#include "app/dds/dds_settings.h"
#include "app/dds/dds_statistics.h"
#include "app/dds/network_addresses.h"
#include "app/dds/participant.h"
#include "app/dds/picture_topics.h"
#include "app/dds/ros/discovery_info.h"
#include "app/dds/status_topics.h"
#include "app/dds/type_watch.h"
#include "app/dds/view_topics.h"
#include "app/pipeline/sink.h"
#include "app/pipeline/status_names.h"
#include "hal/back_off.h"
#include "hal/doorbell.h"
#include "hal/mailbox.h"

namespace orbwatch::app {

/// Publishes views and cameras' pictures as sensor_msgs/Image and CompressedImage, status as
/// ProcessState and diagnostics, and what happens to alarms as events under ROS 2 names, as a ROS 2
/// node, and takes commands; see topic_names.h. One UTC stamp serves everything of a frame set, so
/// that readers can pair images and state exactly. Pictures go out on a thread of each topic, the
/// rest on the sink's, which also joins the domain, again and again until it can, and anew when the
/// host's addresses change. Thread rule: as Sink; statistics() is thread-safe; start may come while
/// views are handed over.
class DdsSink final : public Sink {
 public:
  using Addresses = std::function<std::optional<std::vector<std::string>>()>;

  /// The names in the order of View::index and of FrameSet::frames; each view's and camera's is a
  /// topic part and the frame_id of its images. `handler` carries commands out, on a thread of the
  /// sink; without one nobody takes any. `addresses` are looked at once a second.
  DdsSink(DdsSettings settings, StatusNames names, CommandHandler handler,
          Addresses addresses = network_addresses);
  ~DdsSink() override;

  /// Starts the sink's thread. Does nothing when disabled or running. Errors: a domain or name that
  /// is not allowed, or a name that is there twice. A network that is not there yet is no error.
  Result<> start() override;
  void stop() override;

  void accept_frames(const hal::FrameSet& set) override;
  void accept(const ViewPtr& view) override;
  void accept(const Status& status) override;
  void note(const AlarmNotice& notice) override;

  DdsStatistics statistics() const;

 private:
  struct CameraTopics {
    CameraTopics(const DdsSettings& settings, const std::string& camera);

    const std::string name;
    PictureTopics ball;
  };
  /// Every alarm may be acknowledged and change in one frame set; some of those fit.
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
  const TimeMessage& utc(hal::TimePoint stamp);

  const DdsSettings settings_;
  const StatusNames names_;
  const Addresses addresses_;

  // Between the pipeline's thread and others.
  std::vector<std::unique_ptr<ViewTopics>> views_;
  std::vector<std::unique_ptr<CameraTopics>> cameras_;
  PictureTopics selected_;
  hal::Mailbox<StampedStatus> status_;
  BoundedQueue<StampedNotice, kMaxNotices> notices_;
  hal::Doorbell wake_;
  std::atomic<bool> running_{false};
  std::atomic<std::uint64_t> unknown_views_{0};
  std::atomic<std::uint64_t> joins_{0};
  std::atomic<std::uint64_t> mistyped_{0};

  // The pipeline's thread only.
  hal::TimePoint stamp_;
  TimeMessage utc_{};
  std::size_t selected_view_ = 0;

  // The sink's thread while it runs, else the owner's.
  Participant participant_;
  bool joined_ = false;
  std::vector<std::string> tried_with_;  ///< addresses, when it joined or tried to
  hal::TimePoint next_look_;             ///< at the network
  hal::TimePoint next_try_;              ///< to join, unless the addresses change
  hal::BackOff back_off_;
  std::string refusal_;  ///< why it could not join last; empty when it could
  StatusTopics status_topics_;
  DiscoveryInfo discovery_;
  TypeWatch type_watch_;
  std::thread thread_;

  const bool takes_commands_;
  CommandService commands_;
};

}  // namespace orbwatch::app
