// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/ros/type_hash.h"

#include <algorithm>
#include <string>

#include "app/ports/dds/generated/type_hashes.h"

namespace orbwatch::app::dds {

Result<> announce_type_hash(const Qos& qos, const dds_topic_descriptor_t& type) {
  const auto found =
      std::ranges::find(kTypeHashes, std::string_view(type.m_typename), &TypeHash::type);
  if (found == kTypeHashes.end()) {
    return fail(std::string("no type hash of ") + type.m_typename);
  }
  const std::string user_data = "typehash=" + std::string(found->hash) + ";";
  dds_qset_userdata(qos.get(), user_data.data(), user_data.size());
  return {};
}

}  // namespace orbwatch::app::dds
