#include "app/dds/entity.h"

namespace orbwatch::app {

namespace {

Result<Entity> checked(std::string_view what, dds_entity_t handle) {
  if (handle < 0) return tl::unexpected(dds_error(what, handle));
  return Entity(handle);
}

Qos newest_reliably() {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE,
                       std::chrono::nanoseconds(kMaxBlockingTime).count());
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
  return qos;
}

}  // namespace

Error dds_error(std::string_view what, dds_return_t code) {
  return {"DDS " + std::string(what) + ": " + dds_strretcode(code)};
}

void Entity::reset() {
  // A failure here means that the parent was deleted first and took this one along.
  if (handle_ > 0) dds_delete(handle_);
  handle_ = 0;
}

Qos frame_qos() {
  Qos qos = newest_reliably();
  dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
  return qos;
}

Qos state_qos() {
  Qos qos = newest_reliably();
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  return qos;
}

Result<Entity> make_topic(const Entity& participant, const dds_topic_descriptor_t& type,
                          const std::string& name) {
  return checked("topic " + name,
                 dds_create_topic(participant.get(), &type, name.c_str(), nullptr, nullptr));
}

Result<Entity> make_writer(const Entity& participant, const Entity& topic, const Qos& qos) {
  return checked("writer", dds_create_writer(participant.get(), topic.get(), qos.get(), nullptr));
}

Result<Entity> make_reader(const Entity& participant, const Entity& topic, const Qos& qos) {
  return checked("reader", dds_create_reader(participant.get(), topic.get(), qos.get(), nullptr));
}

std::uint32_t matched_readers(const Entity& writer) {
  dds_publication_matched_status_t status{};
  // A writer of ours cannot be refused this; if it were, it would have no readers.
  if (dds_get_publication_matched_status(writer.get(), &status) != DDS_RETCODE_OK) return 0;
  return status.current_count;
}

}  // namespace orbwatch::app
