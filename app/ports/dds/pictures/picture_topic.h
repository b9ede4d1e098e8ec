// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "app/model/sink/picture_needs.h"
#include "app/ports/dds/pictures/picture_writer.h"
#include "hal/thread/mailbox.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app::dds {

/// A topic of pictures, which are converted, compressed and written on shared threads: a large
/// sample can block in the socket. The newest picture wins; a scarce picture is accepted only while
/// none is being processed, so that a topic never holds two. A topic without a reader has no cost.
/// Thread rule: open and close by one owner; accept on one thread, also concurrently; statistics on
/// any thread.
class PictureTopic {
 public:
  /// `rate`: limit of pictures per second, 0: all.
  PictureTopic(std::string name, std::unique_ptr<PictureWriter> writer,
               std::shared_ptr<hal::SharedThreads> threads, double rate = 0);
  ~PictureTopic() { close(); }

  /// Creates the writer. Error: that of TopicWriter::open(); the topic is then closed.
  Result<> open(const Entity& participant);
  /// Waits for the present write. Keeps no picture.
  void close();

  /// Returns whether a picture of this moment would be sent to a reader. On accept()'s thread.
  bool wants(const TimeMessage& stamp) const;
  /// Queues the picture if the topic has a reader; returns at once. A picture that does not serve
  /// the readers, because they appeared after its rendering had begun, is only counted.
  void accept(const StampedPicture& picture, bool serves = true);
  /// Counts a picture that another topic with the same settings also writes here; returns the
  /// writer for it.
  TopicWriter& take_part(const TimeMessage& stamp);

  const TopicWriter& writer() const { return topic_; }
  std::chrono::nanoseconds cpu_time() const { return work_.cpu_time(); }
  TopicStatistics statistics() const;

 private:
  void write_newest();
  bool is_due(std::chrono::nanoseconds now) const;
  void count_from(std::chrono::nanoseconds now);
  bool was_clock_set(std::chrono::nanoseconds now) const;

  std::unique_ptr<PictureWriter> writer_;
  TopicWriter topic_;
  const std::chrono::nanoseconds period_;  ///< shortest interval of pictures; 0: no limit
  /// Time of the next picture, since 1970; used by the accepting thread only.
  std::chrono::nanoseconds due_{0};
  hal::Mailbox<StampedPicture> mailbox_;
  std::atomic<bool> open_{false};
  /// A picture is in progress, from accept() to the end of its write.
  std::atomic<bool> busy_{false};
  std::atomic<std::uint64_t> passed_over_{0};  ///< scarce pictures that arrived meanwhile
  std::atomic<std::uint64_t> limited_{0};
  hal::SharedThreads::Work work_;
};

/// The two topics of a picture in ROS' image_transport: uncompressed and JPEG.
/// Thread rule: as PictureTopic.
class PictureTopics {
 public:
  static constexpr std::size_t kTopics = 2;

  /// Number of pictures that wait for their topics at once: the newest one, and with a rate limit
  /// also the one that was due last.
  static std::size_t waiting(const JpegSettings& jpeg) { return jpeg.rate > 0 ? 2 : 1; }

  /// `raw` is the name of the sensor_msgs/Image topic; `encoding` Rgb, Bgr or Grey.
  PictureTopics(const std::string& raw, PixelFormat encoding, const JpegSettings& jpeg,
                const std::shared_ptr<hal::SharedThreads>& threads);

  Result<> open(const Entity& participant);
  void close();
  /// The forms in which the readers need the picture of this moment; for the next accept().
  PictureNeeds ask(const TimeMessage& stamp);
  /// Accepts a picture that serves the result of ask(). `same`: topics that also get the picture,
  /// with the same settings, and are closed later: if both are read as JPEG it is compressed once,
  /// and counts as replaced or limited once.
  void accept(const StampedPicture& picture, PictureTopics* same = nullptr);
  std::chrono::nanoseconds cpu_time() const { return raw_.cpu_time() + compressed_.cpu_time(); }
  std::vector<const TopicWriter*> writers() const {
    return {&raw_.writer(), &compressed_.writer()};
  }
  void report(std::vector<TopicStatistics>& topics) const;

 private:
  PixelFormat encoding_;
  PictureTopic raw_;
  PictureTopic compressed_;
  bool raw_asked_ = false;  ///< set by ask(); used by accept()'s thread only
  bool compressed_asked_ = false;
};

}  // namespace orbwatch::app::dds
