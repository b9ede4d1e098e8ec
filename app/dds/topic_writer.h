#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>

#include "app/dds/entity.h"

namespace orbwatch::app {

/// What became of the samples of one topic since the program started.
struct TopicStatistics {
  std::string topic;
  std::uint64_t written = 0;
  std::uint64_t unread = 0;   ///< not written: nobody reads the topic
  std::uint64_t blocked = 0;  ///< given up after kMaxBlockingTime: a reader does not keep up
  std::uint64_t failed = 0;   ///< refused by DDS, or the writer could not be made
  std::string last_error;     ///< of the newest failure; empty when there was none
};

/// One topic and its writer, and the count of what went through.
/// Thread rule: one owner; statistics() is thread-safe.
class TopicWriter {
 public:
  TopicWriter(const dds_topic_descriptor_t& type, std::string name)
      : type_(type), name_(std::move(name)) {}

  /// Creates topic and writer; does nothing when they exist. An error counts as a failed
  /// sample.
  Result<> open(const Entity& participant, const Qos& qos);
  void close();

  bool has_reader() const { return matched_readers(writer_) > 0; }
  void count_unread() { ++unread_; }

  /// Writes one sample of the topic's type and counts what became of it. Waits kMaxBlockingTime at
  /// most. Nothing of the sample is kept or released.
  void write(const void* sample);

  TopicStatistics statistics() const;

 private:
  void count_failure(std::string message);

  const dds_topic_descriptor_t& type_;
  const std::string name_;
  Entity topic_;
  Entity writer_;
  std::atomic<std::uint64_t> written_{0};
  std::atomic<std::uint64_t> unread_{0};
  std::atomic<std::uint64_t> blocked_{0};
  std::atomic<std::uint64_t> failed_{0};
  mutable std::mutex error_mutex_;
  std::string last_error_;
};

}  // namespace orbwatch::app
