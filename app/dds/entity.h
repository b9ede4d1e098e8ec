#pragma once

#include <dds/dds.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "proc/image/result.h"

namespace orbwatch::app {

/// The error of a DDS call that returned `code`: "DDS <what>: <reason>".
Error dds_error(std::string_view what, dds_return_t code);

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

/// For pictures: reliable, the newest only, nothing for readers that come later; a write waits for
/// slow readers at most `kMaxBlockingTime`.
Qos frame_qos();
/// For the process state: as for pictures, but a reader that comes later gets the newest state.
Qos state_qos();
inline constexpr std::chrono::milliseconds kMaxBlockingTime{100};

Result<Entity> make_topic(const Entity& participant, const dds_topic_descriptor_t& type,
                          const std::string& name);
Result<Entity> make_writer(const Entity& participant, const Entity& topic, const Qos& qos);
Result<Entity> make_reader(const Entity& participant, const Entity& topic, const Qos& qos);

/// Readers that match `writer` at this moment.
std::uint32_t matched_readers(const Entity& writer);

}  // namespace orbwatch::app
