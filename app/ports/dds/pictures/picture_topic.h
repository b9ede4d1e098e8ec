#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "app/model/picture_needs.h"
#include "app/ports/dds/pictures/picture_writer.h"
#include "hal/thread/mailbox.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app {

/// A topic of pictures, which are converted, compressed and written on shared threads: a large
/// sample can block in the socket. The newest picture wins; a scarce one is only taken while
/// none is at work, so that a topic never has two of them. A topic without reader costs nothing.
/// Thread rule: open and close by one owner; accept by one thread, also meanwhile; statistics by
/// any.
class PictureTopic {
 public:
  /// `rate`: pictures per second at most, 0: all.
  PictureTopic(std::string name, std::unique_ptr<PictureWriter> writer,
               std::shared_ptr<hal::SharedThreads> threads, double rate = 0);
  ~PictureTopic() { close(); }

  /// Creates the writer. Error: as TopicWriter::open(); then it is closed.
  Result<> open(const Entity& participant);
  /// Waits for the present write. Keeps no picture.
  void close();

  /// Whether a reader would get a picture of this moment. By accept's thread.
  bool wants(const TimeMessage& stamp) const;
  /// Queues the picture if the topic has a reader; returns at once. One that does not serve
  /// readers, since they came after it was begun, is only counted.
  void accept(const StampedPicture& picture, bool serves = true);
  /// Counts a picture that a topic with the same settings writes here, too; returns where to.
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
  const std::chrono::nanoseconds period_;  ///< between two pictures; 0: none
  std::chrono::nanoseconds due_{0};        ///< of the next one, since 1970; the accepting thread's
  hal::Mailbox<StampedPicture> mailbox_;
  std::atomic<bool> open_{false};
  std::atomic<bool> busy_{false};  ///< with a picture, from accept() to the end of its write
  std::atomic<std::uint64_t> passed_over_{0};  ///< scarce ones that came meanwhile
  std::atomic<std::uint64_t> limited_{0};
  hal::SharedThreads::Work work_;
};

/// The two topics of a picture in ROS' image_transport: uncompressed and JPEG.
/// Thread rule: as PictureTopic.
class PictureTopics {
 public:
  static constexpr std::size_t kTopics = 2;

  /// How many pictures wait for their topics at once: the newest, and the one that was due last.
  static std::size_t waiting(const JpegSettings& jpeg) { return jpeg.rate > 0 ? 2 : 1; }

  /// `raw` is the name of the sensor_msgs/Image topic; `encoding` Rgb, Bgr or Grey.
  PictureTopics(const std::string& raw, PixelFormat encoding, const JpegSettings& jpeg,
                const std::shared_ptr<hal::SharedThreads>& threads);

  Result<> open(const Entity& participant);
  void close();
  /// The forms in which the readers need the picture of this moment; for the next accept().
  PictureNeeds ask(const TimeMessage& stamp);
  /// Takes a picture that serves what ask() told, if it told anything. `same`: topics that get the
  /// picture as well, with the same settings, and are closed later: where both are read as JPEG it
  /// is compressed once, and counts as replaced or limited once.
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
  bool raw_asked_ = false;  ///< by ask(); accept's thread
  bool compressed_asked_ = false;
};

}  // namespace orbwatch::app
