// SPDX-License-Identifier: Apache-2.0
#include "tests/app/ports/dds/fastdds/raw_type.h"

namespace orbwatch::tests::fastdds {

namespace {

/// Size that a history reserves for a sample until its actual size is known.
constexpr std::uint32_t kExpectedSize = 4096;

}  // namespace

RawType::RawType(std::string_view name) {
#ifdef FASTDDS_VERSION_MAJOR
  set_name(std::string(name));
  max_serialized_type_size = kExpectedSize;
#else
  setName(std::string(name).c_str());
  m_typeSize = kExpectedSize;
  auto_fill_type_object(false);
  auto_fill_type_information(false);
#endif
}

bool RawType::take(const Payload& payload, void* sample) {
  static_cast<RawSample*>(sample)->assign(payload.data, payload.data + payload.length);
  return true;
}

}  // namespace orbwatch::tests::fastdds
