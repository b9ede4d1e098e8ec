// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "app/ports/dds/participant/entity.h"
#include "app/ports/dds/security/participant_security.h"

namespace orbwatch::app::dds {

/// The largest sample sent or received, serialised: a picture of 8192x5000 in rgb8. Larger ones are
/// dropped; a profile may override it.
inline constexpr std::size_t kMaxSampleBytes = std::size_t{128} << 20;

/// Checks that a DDS domain is 0 to 230.
Result<> check_domain(int domain);
/// Checks that a profile is empty, or an existing file whose path can be passed to Cyclone DDS.
Result<> check_profile(const std::filesystem::path& profile);

/// One participant of a DDS domain. Participants of the same domain share its sockets, threads and
/// configuration in this process. The last one to leave closes them, so that the next join starts
/// anew, for example with other network interfaces. Thread-bound; join and leave of different
/// participants may run at the same time.
class Participant {
 public:
  Participant() = default;
  Participant(Participant&&) noexcept = default;
  Participant& operator=(Participant&& other) noexcept {
    std::swap(domain_, other.domain_);
    std::swap(entity_, other.entity_);
    std::swap(addresses_, other.addresses_);
    return *this;
  }

  /// Joins a domain with the settings of the file `profile`, or of CYCLONEDDS_URI without one; by
  /// default with receive buffers that hold pictures. The first participant of the process in a
  /// domain determines the settings of all. With `security` it communicates with authenticated
  /// participants only, and never by shared memory, which is not encrypted; a process must not have
  /// a second secure participant in a domain: it would get the rights of the first, and Cyclone DDS
  /// 0.10 leaks memory with both. `user_data` is announced to others. Errors: those of
  /// check_domain() and security_qos(); no usable network interface; an invalid CYCLONEDDS_URI or
  /// profile; a missing file.
  static Result<Participant> join(int domain,
                                  const std::optional<SecuritySettings>& security = std::nullopt,
                                  std::string_view user_data = {},
                                  const std::filesystem::path& profile = {});
  void leave();

  const Entity& entity() const { return entity_; }

  /// Addresses that the domain sends from, as bound_addresses(): those of the sockets that were
  /// opened while it was created. If other code created it, those of all UDP sockets of the
  /// process.
  const std::set<std::string>& addresses() const { return addresses_; }

 private:
  /// Empty: other code created the domain.
  std::shared_ptr<const void> domain_;
  Entity entity_;
  std::set<std::string> addresses_;
};

}  // namespace orbwatch::app::dds
