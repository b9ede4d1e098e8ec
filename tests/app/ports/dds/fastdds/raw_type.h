// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>
#include <string>
#include <string_view>
#include <vector>
#if __has_include(<fastdds/config.hpp>)
#include <fastdds/config.hpp>
#else
#include <fastrtps/config.h>
#endif

namespace orbwatch::tests::fastdds {

/// One sample in its wire format, including encapsulation.
using RawSample = std::vector<std::uint8_t>;

/// A type with a name only: its samples stay in wire format as RawSample. For reading only.
class RawType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  explicit RawType(std::string_view name);

#ifdef FASTDDS_VERSION_MAJOR
  using Payload = eprosima::fastdds::rtps::SerializedPayload_t;
  using InstanceHandle = eprosima::fastdds::rtps::InstanceHandle_t;
  using Representation = eprosima::fastdds::dds::DataRepresentationId_t;

  bool serialize(const void*, Payload&, Representation) override { return false; }
  bool deserialize(Payload& payload, void* sample) override { return take(payload, sample); }
  std::uint32_t calculate_serialized_size(const void*, Representation) override { return 0; }
  void* create_data() override { return new RawSample; }
  void delete_data(void* sample) override { delete static_cast<RawSample*>(sample); }
  bool compute_key(Payload&, InstanceHandle&, bool) override { return false; }
  bool compute_key(const void*, InstanceHandle&, bool) override { return false; }
#else
  using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;
  using InstanceHandle = eprosima::fastrtps::rtps::InstanceHandle_t;

  bool serialize(void*, Payload*) override { return false; }
  bool deserialize(Payload* payload, void* sample) override { return take(*payload, sample); }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override {
    return [] { return 0U; };
  }
  void* createData() override { return new RawSample; }
  void deleteData(void* sample) override { delete static_cast<RawSample*>(sample); }
  bool getKey(void*, InstanceHandle*, bool) override { return false; }
#endif

 private:
  static bool take(const Payload& payload, void* sample);
};

}  // namespace orbwatch::tests::fastdds
