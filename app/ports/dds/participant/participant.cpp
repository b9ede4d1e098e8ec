// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/participant/participant.h"

#include <dlfcn.h>

#include <cstdlib>
#include <map>
#include <mutex>

#include "app/ports/dds/participant/network_addresses.h"

namespace orbwatch::app::dds {

namespace {

/// Highest domain whose ports are below 65536 (DDSI-RTPS 2.5, 9.6.2.3: 7400 + 250 per domain), with
/// room for participants.
constexpr int kMaxDomain = 230;

/// SocketReceiveBufferSize: a picture arrives faster than it is read, and fragments beyond the
/// socket's buffer are lost; the system grants net.core.rmem_max at most. MultipleReceiveThreads:
/// to stop a thread with its own socket Cyclone DDS sends a packet to its own address, and hangs if
/// that address was removed. MaxSampleSize: without it one foreign sample could exhaust the memory.
const std::string kDefaults =
    "<CycloneDDS><Domain><Internal><MultipleReceiveThreads>false</MultipleReceiveThreads>"
    "<MaxSampleSize>" +
    std::to_string(kMaxSampleBytes) +
    "B</MaxSampleSize><SocketReceiveBufferSize min=\"default\" max=\"16MB\"/>"
    "</Internal></Domain></CycloneDDS>";

/// Overrides a profile that enables shared memory: Cyclone DDS 0.10 puts samples there unencrypted,
/// also those of a secure participant.
constexpr const char* kNoSharedMemory =
    "<CycloneDDS><Domain><SharedMemory><Enable>false</Enable></SharedMemory></Domain></CycloneDDS>";

/// Returns whether Cyclone DDS was built with shared memory. Without it kNoSharedMemory and such
/// profiles are errors. The library has no call that returns this, but exports its functions for
/// shared memory.
bool has_shared_memory() { return ::dlsym(RTLD_DEFAULT, "shm_create_chunk") != nullptr; }

struct OwnDomain {
  Entity entity;
  std::set<std::string> addresses;  ///< of its sockets
  int users = 0;
};
/// Also held while domains are created and deleted: Cyclone DDS refuses to create an existing one.
std::mutex domains_mutex;
std::map<int, OwnDomain> domains;  // domains by number

/// One use of a domain that we created; the last use deletes it.
class DomainUse {
 public:
  /// Registers the use; the caller holds the mutex.
  explicit DomainUse(int number) : number_(number), addresses_(domains[number].addresses) {
    ++domains[number].users;
  }
  ~DomainUse() {
    const std::lock_guard lock(domains_mutex);
    if (--domains[number_].users == 0) domains.erase(number_);
  }
  DomainUse(const DomainUse&) = delete;
  DomainUse& operator=(const DomainUse&) = delete;

  const std::set<std::string>& addresses() const { return addresses_; }

 private:
  const int number_;
  const std::set<std::string> addresses_;
};

/// Later elements override earlier ones.
std::string configuration(const std::filesystem::path& profile, bool is_secure) {
  std::string all = kDefaults;
  if (!profile.empty()) {
    all += ",file://" + profile.string();
  } else if (const char* uri = std::getenv("CYCLONEDDS_URI")) {
    all += std::string(",") + uri;
  }
  if (is_secure && has_shared_memory()) all += std::string(",") + kNoSharedMemory;
  return all;
}

Error cannot_join(int domain, dds_return_t code) {
  return {dds_error("domain " + std::to_string(domain), code).message +
          "; is a network interface up, and the profile or CYCLONEDDS_URI, if set, valid?"};
}

/// Error after a refusal by Cyclone's plugins, which log the reason.
Error refused_by_plugins(int domain, const SecuritySettings& security) {
  return {
      dds_error("domain " + std::to_string(domain), DDS_RETCODE_NOT_ALLOWED_BY_SECURITY).message +
      "; do the documents in " + security.folder.string() + " follow DDS Security 1.1?"};
}

/// Creates the domain unless it exists; empty: other code of the process created it.
Result<std::shared_ptr<const DomainUse>> use_domain(int number,
                                                    const std::filesystem::path& profile,
                                                    bool is_secure) {
  const std::lock_guard lock(domains_mutex);
  if (!domains.contains(number)) {
    const auto earlier = open_sockets();
    const auto handle = dds_create_domain(static_cast<dds_domainid_t>(number),
                                          configuration(profile, is_secure).c_str());
    if (handle == DDS_RETCODE_PRECONDITION_NOT_MET) return nullptr;
    if (handle < 0) return tl::unexpected(cannot_join(number, handle));
    domains[number].entity = Entity(handle);
    domains[number].addresses = bound_addresses(earlier);
  }
  return std::make_shared<const DomainUse>(number);
}

}  // namespace

Result<> check_domain(int domain) {
  if (domain >= 0 && domain <= kMaxDomain) return {};
  return fail("DDS domain " + std::to_string(domain) + ": out of range, 0 to " +
              std::to_string(kMaxDomain));
}

Result<> check_profile(const std::filesystem::path& profile) {
  if (profile.string().find(',') != std::string::npos) {
    return fail(
        "DDS profile " + profile.string() +
        ": must not have a comma in its path, which Cyclone DDS reads as the end; rename it");
  }
  std::error_code ignored;  // an inaccessible file counts as missing
  if (profile.empty() || std::filesystem::is_regular_file(profile, ignored)) return {};
  return fail("DDS profile " + profile.string() + ": no such file");
}

Result<Participant> Participant::join(int domain, const std::optional<SecuritySettings>& security,
                                      std::string_view user_data,
                                      const std::filesystem::path& profile) {
  if (const auto checked = check_domain(domain); !checked) return tl::unexpected(checked.error());
  if (const auto checked = check_profile(profile); !checked) return tl::unexpected(checked.error());
  auto qos = security ? security_qos(*security, domain) : Qos(dds_create_qos());
  if (!qos) return tl::unexpected(qos.error());
  if (!user_data.empty()) dds_qset_userdata(qos->get(), user_data.data(), user_data.size());
  auto used = use_domain(domain, profile, security.has_value());
  if (!used) return tl::unexpected(used.error());
  Participant participant;
  participant.addresses_ = *used ? (*used)->addresses() : bound_addresses();
  participant.domain_ = std::move(*used);
  const auto handle =
      dds_create_participant(static_cast<dds_domainid_t>(domain), qos->get(), nullptr);
  if (handle == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY) {
    return tl::unexpected(refused_by_plugins(domain, *security));
  }
  if (handle < 0) return tl::unexpected(cannot_join(domain, handle));
  participant.entity_ = Entity(handle);
  return participant;
}

void Participant::leave() {
  entity_.reset();
  domain_.reset();
  addresses_.clear();
}

}  // namespace orbwatch::app::dds
