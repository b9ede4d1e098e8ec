#include "app/dds/type_watch.h"

#include "app/dds/samples.h"
#include "app/log.h"

namespace orbwatch::app {

Result<> TypeWatch::open(const Entity& participant, std::map<std::string, std::string> types) {
  types_ = std::move(types);
  const auto open_one = [&participant](dds_entity_t topic, Entity& reader) -> Result<> {
    const dds_entity_t handle = dds_create_reader(participant.get(), topic, nullptr, nullptr);
    if (handle < 0) return tl::unexpected(dds_error("reader of what is on the network", handle));
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

std::uint64_t TypeWatch::look() {
  look(writers_, "writer");
  look(readers_, "reader");
  return count_;
}

void TypeWatch::look(const Entity& reader, const char* kind) {
  if (!reader) return;
  const auto judge = [&](const void* sample, const dds_sample_info_t&) {
    const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(sample);
    const auto ours = types_.find(endpoint.topic_name);
    if (ours == types_.end() || ours->second == endpoint.type_name) return;
    ++count_;
    if (found_[ours->first]++ > 0) return;
    // The other's own text is not repeated: it may hold anything.
    log_line(LogLevel::Warning, "DDS: somebody has a " + std::string(kind) + " of " + ours->first +
                                    " with another type than " + ours->second +
                                    ", which never connects");
  };
  // A failure means that the participant is gone: then there is nothing to see.
  for (auto taken = take_samples(reader.get(), judge); taken && *taken > 0;) {
    taken = take_samples(reader.get(), judge);
  }
}

}  // namespace orbwatch::app
