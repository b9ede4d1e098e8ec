#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "app/dds/image_topic.h"
#include "app/dds/participant.h"
#include "app/dds/process_state.h"
#include "app/dds/topic_writer.h"
#include "app/pipeline/sink.h"
#include "hal/mailbox.h"

namespace orbwatch::app {

/// Where to publish. The network interface and the like come from CYCLONEDDS_URI, as everywhere in
/// Cyclone DDS.
struct DdsSettings {
  bool enabled = true;
  int domain = 0;                   ///< DDS domain, ROS_DOMAIN_ID of ROS 2; 0 to 230
  std::string prefix = "orbwatch";  ///< topics are rt/<prefix>/...
};

/// What became of the views and states handed over, since construction.
struct DdsStatistics {
  std::vector<TopicStatistics> topics;
  std::vector<std::uint64_t> dropped_views;  ///< by View::index: replaced by a newer one
  std::uint64_t dropped_states = 0;          ///< replaced by a newer one
  std::uint64_t unknown_views = 0;           ///< View::index beyond the list of names
};

/// Publishes views as sensor_msgs/Image and status as ProcessState under ROS 2 names; see
/// topic_names.h. One UTC stamp serves everything of a frame set, so that readers can pair images
/// and state exactly.
/// Thread rule: as Sink; statistics() is thread-safe; start may come while views are handed over.
class DdsSink final : public Sink {
 public:
  /// `view_names` in the order of View::index; each is a topic part and the frame_id of its images.
  DdsSink(DdsSettings settings, std::vector<std::string> view_names);
  ~DdsSink() override;

  /// Joins the domain and starts the thread that writes. Does nothing when disabled or running.
  /// Errors: a name that ROS 2 does not allow or that is there twice, no usable network interface;
  /// the sink can then be started again later.
  Result<> start() override;
  void stop() override;

  void accept(const ViewPtr& view) override;
  void accept(const Status& status) override;

  DdsStatistics statistics() const;

 private:
  struct StampedView {
    ViewPtr view;
    TimeMessage stamp;
  };
  struct StampedStatus {
    Status status;
    TimeMessage stamp;
  };
  /// The way of one view from the pipeline to its topics.
  struct Channel {
    Channel(const std::string& prefix, const std::string& view_name);

    std::string name;
    hal::Mailbox<StampedView> mailbox;
    ImageTopic colour;
    ImageTopic radiometric;  ///< opened with the first view that has such a plane
  };
  struct Wake {};

  Result<> check_names() const;
  Result<> open();
  void close();
  void run();
  void publish(Channel& channel, std::size_t index, const StampedView& stamped);
  /// UTC of a stamp, the same for the same stamp; on the pipeline's thread.
  const TimeMessage& utc(hal::TimePoint stamp);

  const DdsSettings settings_;
  const std::vector<std::string> view_names_;

  // Between the pipeline's thread and the sink's.
  std::vector<std::unique_ptr<Channel>> channels_;
  hal::Mailbox<StampedStatus> status_;
  hal::Mailbox<Wake> wake_;
  std::atomic<bool> running_{false};
  std::atomic<std::uint64_t> unknown_views_{0};

  // The pipeline's thread only.
  hal::TimePoint stamp_;
  TimeMessage utc_{};

  // The sink's thread while it runs, else the owner's.
  Participant participant_;
  ImageTopic selected_;
  TopicWriter state_;
  ProcessStateComposer composer_;
  std::size_t selected_view_ = 0;
  std::thread thread_;
};

}  // namespace orbwatch::app
