// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/participant/entity.h"

#include <mutex>

namespace orbwatch::app::dds {

namespace {

Result<Entity> checked(std::string_view what, dds_entity_t handle) {
  if (handle < 0) return tl::unexpected(dds_error(what, handle));
  return Entity(handle);
}

/// The history for late joiners has its own depth, 1 by default.
void keep_for_late_joiners(const Qos& qos, std::int32_t depth) {
  dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, depth, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
}

Qos newest_reliably(dds_durability_kind_t durability, std::int32_t depth = 1) {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE,
                       std::chrono::nanoseconds(kMaxBlockingTime).count());
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, depth);
  dds_qset_durability(qos.get(), durability);
  return qos;
}

}  // namespace

Error dds_error(std::string_view what, dds_return_t code) {
  return {"DDS " + std::string(what) + ": " + dds_strretcode(code)};
}

bool is_refused_by_security(const Error& error) {
  const std::string_view reason = dds_strretcode(DDS_RETCODE_NOT_ALLOWED_BY_SECURITY);
  return error.message.find(reason) != std::string::npos;
}

void Entity::reset() {
  // The call fails only if the parent was deleted before, and this entity with it.
  if (handle_ > 0) dds_delete(handle_);
  handle_ = 0;
}

Qos frame_qos() { return newest_reliably(DDS_DURABILITY_VOLATILE); }

Qos state_qos() { return newest_reliably(DDS_DURABILITY_TRANSIENT_LOCAL); }

Qos process_state_qos() {
  Qos qos = newest_reliably(DDS_DURABILITY_TRANSIENT_LOCAL, kStateDepth);
  keep_for_late_joiners(qos, 1);
  return qos;
}

Qos event_qos() {
  Qos qos = newest_reliably(DDS_DURABILITY_TRANSIENT_LOCAL, kEventDepth);
  keep_for_late_joiners(qos, kEventDepth);
  return qos;
}

Qos command_qos() { return newest_reliably(DDS_DURABILITY_VOLATILE, kCommandDepth); }

Qos machine_state_qos() {
  Qos qos = command_qos();
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
  return qos;
}

void show_order_of_calls() {
  static std::mutex mutex;
  const std::lock_guard passes_the_order_on(mutex);
}

Result<Entity> make_topic(const Entity& participant, const dds_topic_descriptor_t& type,
                          const std::string& name) {
  return checked("topic " + name,
                 dds_create_topic(participant.get(), &type, name.c_str(), nullptr, nullptr));
}

Result<Entity> make_writer(const Entity& participant, const Entity& topic, const Qos& qos,
                           const dds_listener_t* listener) {
  return checked("writer", dds_create_writer(participant.get(), topic.get(), qos.get(), listener));
}

Result<Entity> make_reader(const Entity& participant, const Entity& topic, const Qos& qos,
                           const dds_listener_t* listener) {
  return checked("reader", dds_create_reader(participant.get(), topic.get(), qos.get(), listener));
}

}  // namespace orbwatch::app::dds
