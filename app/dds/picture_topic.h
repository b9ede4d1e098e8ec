#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "app/dds/picture_writer.h"
#include "hal/mailbox.h"

namespace orbwatch::app {

/// A topic of pictures and its own thread, on which they are converted, compressed and written: a
/// large sample can block in the socket. The newest picture wins, and what nobody reads costs
/// nothing.
/// Thread rule: open and close by one owner; accept by one thread, also meanwhile; statistics by
/// any.
class PictureTopic {
 public:
  /// `rate`: pictures per second at most, 0: all.
  PictureTopic(std::string name, std::unique_ptr<PictureWriter> writer, double rate = 0);
  ~PictureTopic() { close(); }

  /// Creates the writer and starts the thread. Error: as TopicWriter::open(); then it is closed.
  Result<> open(const Entity& participant);
  /// Ends the thread after what it writes now. Keeps no picture.
  void close();

  /// Takes the picture if somebody reads the topic; returns at once.
  void accept(const StampedPicture& picture);

  const TopicWriter& writer() const { return topic_; }
  TopicStatistics statistics() const;

 private:
  void run();
  bool is_due(const TimeMessage& stamp);

  std::unique_ptr<PictureWriter> writer_;
  TopicWriter topic_;
  const std::chrono::nanoseconds period_;  ///< between two pictures; 0: none
  std::chrono::nanoseconds due_{0};        ///< the next one, since 1970; the sender's
  hal::Mailbox<StampedPicture> mailbox_;
  std::atomic<bool> open_{false};
  std::atomic<std::uint64_t> limited_{0};
  std::thread thread_;
};

}  // namespace orbwatch::app
