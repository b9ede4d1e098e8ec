// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/app/ports/dds/cdr.h"
#include "tests/app/ports/dds/topic_reader.h"

/// Wire data of a topic for other DDS implementations: its announcement and the bytes of a sample.
namespace orbwatch::app::tests {

struct Sample {
  Bytes header;   ///< encapsulation: representation and options
  Bytes payload;  ///< without the padding stated in the options
};

/// The next sample in wire format, if there is one.
template <class Message>
bool take_bytes(const TopicReader<Message>& reader, Sample& sample) {
  if (!reader.wait()) return false;
  ddsi_serdata* serialized = nullptr;
  dds_sample_info_t info{};
  if (dds_takecdr(reader.get(), &serialized, 1, &info, DDS_ANY_STATE) != 1) return false;
  Bytes all(ddsi_serdata_size(serialized));
  ddsi_serdata_to_ser(serialized, 0, all.size(), all.data());
  ddsi_serdata_unref(serialized);
  EXPECT_GE(all.size(), 4u);
  const std::size_t padding = all[3] & 3;
  sample.header = {all[0], all[1]};
  sample.payload = Bytes(all.begin() + 4, all.end() - static_cast<std::ptrdiff_t>(padding));
  return true;
}

struct Announcement {
  std::string topic;
  std::string type;
  std::string user_data;
  dds_reliability_kind_t reliability{};
  dds_duration_t max_blocking_time = 0;
  dds_durability_kind_t durability{};
  dds_history_kind_t history{};
  std::int32_t depth = 0;
  std::vector<dds_data_representation_id_t> representations;
};

/// Reads the announcement of the writer that `reader` has matched.
inline bool announcement(dds_entity_t reader, Announcement& told) {
  dds_instance_handle_t writer = 0;
  if (dds_get_matched_publications(reader, &writer, 1) < 1) return false;
  dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(reader, writer);
  if (endpoint == nullptr) return false;
  told.topic = endpoint->topic_name;
  told.type = endpoint->type_name;
  void* data = nullptr;
  std::size_t size = 0;
  if (dds_qget_userdata(endpoint->qos, &data, &size)) {
    told.user_data.assign(static_cast<const char*>(data), size);
    dds_free(data);
  }
  dds_qget_reliability(endpoint->qos, &told.reliability, &told.max_blocking_time);
  dds_qget_durability(endpoint->qos, &told.durability);
  dds_qget_history(endpoint->qos, &told.history, &told.depth);
  std::uint32_t count = 0;
  dds_data_representation_id_t* values = nullptr;
  if (dds_qget_data_representation(endpoint->qos, &count, &values)) {
    told.representations.assign(values, values + count);
    dds_free(values);
  }
  dds_builtintopic_free_endpoint(endpoint);
  return true;
}

}  // namespace orbwatch::app::tests
