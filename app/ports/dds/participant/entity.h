// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "proc/image/result.h"

namespace orbwatch::app::dds {

/// The error of a DDS call that returned `code`: "DDS <what>: <reason>".
Error dds_error(std::string_view what, dds_return_t code);
/// Returns whether a dds_error(), also with further text, is a refusal by access control: the keys
/// do not permit the topic.
bool is_refused_by_security(const Error& error);

/// Owns one handle of the DDS C API. Thread-safe as far as the handle's own calls are.
class Entity {
 public:
  Entity() = default;
  explicit Entity(dds_entity_t handle) : handle_(handle) {}
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Entity() { reset(); }

  /// Deletes the entity with everything that was created from it.
  void reset();
  dds_entity_t get() const { return handle_; }
  explicit operator bool() const { return handle_ > 0; }

 private:
  dds_entity_t handle_ = 0;
};

struct QosDeleter {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;

struct ListenerDeleter {
  void operator()(dds_listener_t* listener) const { dds_delete_listener(listener); }
};
using Listener = std::unique_ptr<dds_listener_t, ListenerDeleter>;

/// QoS of pictures: reliable, keep last 1, volatile; a write waits for slow readers at most
/// `kMaxBlockingTime`.
Qos frame_qos();
/// QoS of states and of the process state's readers: as for pictures, but a late joiner gets the
/// newest state.
Qos state_qos();
/// QoS of the process state's writer: as state_qos(), but the last kStateDepth states are sent
/// again to a reader that lost them. With a depth of 1 the next state would replace a lost result.
Qos process_state_qos();
/// Exceeds the results that StatusQueue publishes at once, with room for the states that follow
/// until a reader has reported the loss.
inline constexpr std::int32_t kStateDepth = 16;
/// QoS of events: reliable; a late joiner gets the last kEventDepth.
Qos event_qos();
inline constexpr std::int32_t kEventDepth = 64;
/// QoS of commands and their results: reliable, volatile.
Qos command_qos();
inline constexpr std::int32_t kCommandDepth = 16;
/// QoS of the reader of machine states: best effort, which writers of either kind match; volatile.
Qos machine_state_qos();
inline constexpr std::chrono::milliseconds kMaxBlockingTime{100};

/// Declares to a race detector that Cyclone DDS calls a listener only between its creation and its
/// end: Cyclone orders this by its own atomics, which are invisible to the detector. Called before
/// a listener is passed on, at begin and end of each call, and after the entity is gone.
/// Thread-safe.
void show_order_of_calls();

Result<Entity> make_topic(const Entity& participant, const dds_topic_descriptor_t& type,
                          const std::string& name);
/// Creates a writer. `listener`, if not null, is copied; it may be called before this returns.
Result<Entity> make_writer(const Entity& participant, const Entity& topic, const Qos& qos,
                           const dds_listener_t* listener = nullptr);
Result<Entity> make_reader(const Entity& participant, const Entity& topic, const Qos& qos,
                           const dds_listener_t* listener = nullptr);

}  // namespace orbwatch::app::dds
