// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <type_traits>

#include "app/model/status/field.h"
#include "app/ports/dds/participant/entity.h"

namespace orbwatch::app::dds {

#define ORBWATCH_DDS_TOPIC_FIGURES(FIELD)                                                      \
  FIELD(std::uint64_t, readers, kCount, "Readers that are matched now")                        \
  FIELD(std::uint64_t, written, kCount, "Samples written")                                     \
  FIELD(std::uint64_t, unread, kCount, "Samples without a reader")                             \
  FIELD(std::uint64_t, replaced, kCount,                                                       \
        "Samples replaced by a newer one before the write; of a camera's own pictures, those " \
        "during a write")                                                                      \
  FIELD(std::uint64_t, limited, kCount, "Samples above the topic's rate")                      \
  FIELD(std::uint64_t, blocked, kCount, "Samples abandoned because a reader did not keep up")  \
  FIELD(std::uint64_t, failed, kCount, "Samples refused by DDS, or whose writer could not be made")

/// The samples of one topic since the program started, each counted once.
struct TopicStatistics {
  std::string topic;
  /// Text of the newest failure; empty: none yet.
  ORBWATCH_DDS_TOPIC_FIGURES(ORBWATCH_FIELD_MEMBER) std::string last_error{};
};

template <class Visit>
constexpr void for_each_field(std::type_identity<TopicStatistics>, Visit&& visit) {
  using Part = TopicStatistics;
  ORBWATCH_DDS_TOPIC_FIGURES(ORBWATCH_VISIT_FIELD)
}

/// One topic and its writer, with statistics.
/// Thread rule: one owner opens and closes; in between, everything else is thread-safe.
class TopicWriter {
 public:
  TopicWriter(const dds_topic_descriptor_t& type, std::string name)
      : type_(type), name_(std::move(name)) {}
  ~TopicWriter() { close(); }
  TopicWriter(const TopicWriter&) = delete;  // Cyclone DDS keeps its address
  TopicWriter& operator=(const TopicWriter&) = delete;

  /// Creates topic and writer, which announces its type's hash; does nothing if they exist. An
  /// error counts as a failed sample.
  Result<> open(const Entity& participant, const Qos& qos);
  void close();

  /// Returns whether the topic has a reader at present. Thread-safe, never waits.
  bool has_reader() const { return readers_ > 0; }
  void count_unread() { ++unread_; }

  /// Writes and counts one sample of the topic's type. Waits kMaxBlockingTime at most. Keeps and
  /// releases nothing of the sample.
  void write(const void* sample);

  void count_failure(std::string message);

  TopicStatistics statistics() const;
  dds_entity_t get() const { return writer_.get(); }
  const std::string& name() const { return name_; }
  const char* type_name() const { return type_.m_typename; }

 private:
  /// Called on a thread of Cyclone DDS.
  static void count_readers(dds_entity_t writer, dds_publication_matched_status_t status,
                            void* topic);

  const dds_topic_descriptor_t& type_;
  const std::string name_;
  Entity topic_;
  Entity writer_;
  std::atomic<std::uint32_t> readers_{0};
  std::atomic<std::uint64_t> written_{0};
  std::atomic<std::uint64_t> unread_{0};
  std::atomic<std::uint64_t> blocked_{0};
  std::atomic<std::uint64_t> failed_{0};
  mutable std::mutex mutex_;
  std::string last_error_;
};

}  // namespace orbwatch::app::dds
