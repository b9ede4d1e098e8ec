#pragma once

#include <memory>
#include <utility>

#include "app/dds/entity.h"

namespace orbwatch::app {

/// One participant of a DDS domain. Participants of the same domain share what the process keeps of
/// it (sockets, threads, configuration); the last to leave closes it, so that joining again starts
/// afresh, with other network interfaces for example. Thread-bound; join and leave of different
/// participants may run at the same time.
class Participant {
 public:
  Participant() = default;
  Participant(Participant&&) noexcept = default;
  Participant& operator=(Participant&& other) noexcept {
    std::swap(domain_, other.domain_);
    std::swap(entity_, other.entity_);
    return *this;
  }

  /// Joins a domain as CYCLONEDDS_URI says; where that says nothing, with receive buffers that hold
  /// pictures. Error: number not 0 to 230, no usable network interface, invalid CYCLONEDDS_URI.
  static Result<Participant> join(int domain);
  void leave();

  const Entity& entity() const { return entity_; }

 private:
  std::shared_ptr<Entity> domain_;  ///< empty when the domain is somebody else's
  Entity entity_;
};

}  // namespace orbwatch::app
