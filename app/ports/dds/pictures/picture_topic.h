#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "app/ports/dds/pictures/picture_writer.h"
#include "hal/thread/mailbox.h"
#include "hal/thread/thread.h"

namespace orbwatch::app {

/// A topic of pictures and its own thread, on which they are converted, compressed and written: a
/// large sample can block in the socket. The newest picture wins; a scarce one is only taken while
/// none is at work, so that a topic never has two of them. A topic without reader costs nothing.
/// Thread rule: open and close by one owner; accept by one thread, also meanwhile; statistics by
/// any.
class PictureTopic {
 public:
  /// `rate`: pictures per second at most, 0: all.
  PictureTopic(std::string name, std::unique_ptr<PictureWriter> writer, double rate = 0);
  ~PictureTopic() { close(); }

  /// Creates the writer and starts the thread. Error: as TopicWriter::open(); then it is closed.
  Result<> open(const Entity& participant);
  /// Ends the thread after its present write. Keeps no picture.
  void close();

  /// Queues the picture if the topic has a reader; returns at once.
  void accept(const StampedPicture& picture);

  const TopicWriter& writer() const { return topic_; }
  TopicStatistics statistics() const;

 private:
  void run();
  bool is_due(std::chrono::nanoseconds now) const;
  bool was_clock_set(std::chrono::nanoseconds now) const;

  std::unique_ptr<PictureWriter> writer_;
  TopicWriter topic_;
  const std::chrono::nanoseconds period_;  ///< between two pictures; 0: none
  std::chrono::nanoseconds due_{0};        ///< of the next one, since 1970; the accepting thread's
  hal::Mailbox<StampedPicture> mailbox_;
  std::atomic<bool> open_{false};
  std::atomic<bool> busy_{false};  ///< with a picture, from accept() to the end of its write
  std::atomic<std::uint64_t> passed_over_{0};  ///< scarce ones that came meanwhile
  std::atomic<std::uint64_t> limited_{0};
  hal::Thread thread_;
};

/// The two topics of a picture in ROS' image_transport: uncompressed and JPEG.
/// Thread rule: as PictureTopic.
class PictureTopics {
 public:
  static constexpr std::size_t kTopics = 2;

  /// `raw` is the name of the sensor_msgs/Image topic; `encoding` Rgb, Bgr or Grey.
  PictureTopics(const std::string& raw, PixelFormat encoding, const JpegSettings& jpeg);

  Result<> open(const Entity& participant);
  void close();
  void accept(const StampedPicture& picture);
  std::vector<const TopicWriter*> writers() const {
    return {&raw_.writer(), &compressed_.writer()};
  }
  void report(std::vector<TopicStatistics>& topics) const;

 private:
  PictureTopic raw_;
  PictureTopic compressed_;
};

}  // namespace orbwatch::app
