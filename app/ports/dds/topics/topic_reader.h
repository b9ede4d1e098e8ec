// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/ports/dds/participant/entity.h"

namespace orbwatch::app::dds {

/// One topic and its reader. Thread rule: one owner.
class TopicReader {
 public:
  TopicReader(const dds_topic_descriptor_t& type, std::string name)
      : type_(&type), name_(std::move(name)) {}

  /// Creates topic and reader. `listener`, if not null, is copied; it may be called before this
  /// returns. Error: a failure of DDS.
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

/// Limit of samples that take_samples() takes at once; a reader's history need not be deeper.
inline constexpr std::int32_t kMaxTaken = 8;

/// Receives a sample of the topic's type, which is valid during the call only.
using AcceptSample = std::function<void(const void* sample, const dds_sample_info_t& info)>;

/// Takes the samples that a reader holds now, kMaxTaken at most, without waiting. Returns their
/// number, including those without data. Thread-safe. Error: a failure of DDS.
Result<std::size_t> take_samples(dds_entity_t reader, const AcceptSample& accept);

/// Takes all samples that a reader holds, for its listener: the call fails only while the reader is
/// being deleted. Thread-safe.
void take_all_samples(dds_entity_t reader, const AcceptSample& accept);

/// A wait set that wakes when any of `readers` has data. It is deleted with `participant`; each
/// reader leaves it when it is deleted.
Result<Entity> make_wait_set(const Entity& participant, const std::vector<dds_entity_t>& readers);

/// Waits; returns whether data arrived before the timeout. Thread-bound. Error: a failure of DDS.
Result<bool> wait_for_data(const Entity& wait_set, std::chrono::nanoseconds timeout);

}  // namespace orbwatch::app::dds
