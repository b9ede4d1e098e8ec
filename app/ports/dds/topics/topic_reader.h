#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/ports/dds/participant/entity.h"

namespace orbwatch::app {

/// One topic and its reader. Thread rule: one owner.
class TopicReader {
 public:
  TopicReader(const dds_topic_descriptor_t& type, std::string name)
      : type_(&type), name_(std::move(name)) {}

  /// Creates topic and reader. `listener`, if there is one, is copied; it may be called before this
  /// returns. Error: DDS refuses.
  Result<> open(const Entity& participant, const Qos& qos,
                const dds_listener_t* listener = nullptr);
  /// Waits for the listener to end; it is not called afterwards.
  void close();

  dds_entity_t get() const { return reader_.get(); }
  const std::string& name() const { return name_; }
  const char* type_name() const { return type_->m_typename; }

 private:
  const dds_topic_descriptor_t* type_;
  std::string name_;
  Entity topic_;
  Entity reader_;
};

/// The maximum that take_samples() takes at once; a reader's history need not be deeper.
inline constexpr std::int32_t kMaxTaken = 8;

/// Receives a sample of the topic's type, which is valid during the call only.
using AcceptSample = std::function<void(const void* sample, const dds_sample_info_t& info)>;

/// Takes the samples that a reader holds now, kMaxTaken at most, without waiting. Returns their
/// number, including those without data. Thread-safe. Error: DDS refuses.
Result<std::size_t> take_samples(dds_entity_t reader, const AcceptSample& accept);

/// A wait set that wakes when any of `readers` has data. It ends with `participant`, each reader's
/// part in it with the reader.
Result<Entity> make_wait_set(const Entity& participant, const std::vector<dds_entity_t>& readers);

/// Whether data arrives before the timeout. Thread-bound. Error: DDS refuses.
Result<bool> wait_for_data(const Entity& wait_set, std::chrono::nanoseconds timeout);

}  // namespace orbwatch::app
