// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/topics/type_watch.h"

#include "app/log.h"
#include "app/ports/dds/topics/topic_reader.h"

namespace orbwatch::app::dds {

Result<> TypeWatch::open(const Entity& participant, std::map<std::string, std::string> types) {
  types_ = std::move(types);
  const auto open_one = [&participant](dds_entity_t topic, Entity& reader) -> Result<> {
    const dds_entity_t handle = dds_create_reader(participant.get(), topic, nullptr, nullptr);
    if (handle < 0) return tl::unexpected(dds_error("reader of discovered endpoints", handle));
    reader = Entity(handle);
    return {};
  };
  return open_one(DDS_BUILTIN_TOPIC_DCPSPUBLICATION, writers_).and_then([&] {
    return open_one(DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, readers_);
  });
}

void TypeWatch::close() {
  writers_.reset();
  readers_.reset();
}

std::uint64_t TypeWatch::update() {
  update(writers_, "writer");
  update(readers_, "reader");
  return count_;
}

void TypeWatch::update(const Entity& reader, const char* kind) {
  if (!reader) return;
  const auto judge = [&](const void* sample, const dds_sample_info_t&) {
    const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(sample);
    const auto ours = types_.find(endpoint.topic_name);
    if (ours == types_.end() || ours->second == endpoint.type_name) return;
    ++count_;
    if (found_[ours->first]++ > 0) return;
    // The message does not quote the foreign type name, which may contain control characters.
    log_line(LogLevel::Warning, "DDS: discovered a foreign " + std::string(kind) + " of " +
                                    ours->first + " with another type than " + ours->second +
                                    "; it will not be matched");
  };
  // The call fails only if the participant has been deleted.
  for (auto taken = take_samples(reader.get(), judge); taken && *taken > 0;) {
    taken = take_samples(reader.get(), judge);
  }
}

}  // namespace orbwatch::app::dds
