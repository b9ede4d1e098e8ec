#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "app/dds/entity.h"
#include "app/dds/security/participant_security.h"

namespace orbwatch::app {

/// The largest sample that is sent or taken, serialised: a picture of 8192x5000 in rgb8. Larger
/// ones are dropped; a profile may say otherwise.
inline constexpr std::size_t kMaxSampleBytes = std::size_t{128} << 20;

/// Whether there is such a DDS domain: 0 to 230.
Result<> check_domain(int domain);
/// Whether there is such a file with settings of the network, and Cyclone DDS can be told its path;
/// an empty one stands for none.
Result<> check_profile(const std::filesystem::path& profile);

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

  /// Joins a domain as the file `profile` says, or CYCLONEDDS_URI without one; where that says
  /// nothing, with receive buffers that hold pictures. The first of the process to join a domain
  /// says it for all. With `security` only authenticated participants see and are seen. There must
  /// not be a second one of those in the domain in this process at the same time: it would get the
  /// rights of the first one, and Cyclone DDS 0.10 leaks what it decrypts for both. `user_data` is
  /// what others are told of it. Errors: as check_domain() and security_qos(), no usable network
  /// interface, invalid CYCLONEDDS_URI or profile, no such file.
  static Result<Participant> join(int domain,
                                  const std::optional<SecuritySettings>& security = std::nullopt,
                                  std::string_view user_data = {},
                                  const std::filesystem::path& profile = {});
  void leave();

  const Entity& entity() const { return entity_; }

 private:
  std::shared_ptr<const void> domain_;  ///< empty when the domain is somebody else's
  Entity entity_;
};

}  // namespace orbwatch::app
