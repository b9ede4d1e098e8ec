#include "app/dds/participant.h"

#include <cstdlib>
#include <map>
#include <mutex>

namespace orbwatch::app {

namespace {

/// The highest domain whose ports lie below 65536 (DDSI-RTPS 2.5, 9.6.2.3: 7400 + 250 per domain),
/// with room for participants.
constexpr int kMaxDomain = 230;

/// A picture arrives faster than it is read; what does not fit the socket's buffer is lost. The
/// system grants net.core.rmem_max at most.
constexpr const char* kDefaults =
    "<CycloneDDS><Domain><Internal>"
    "<SocketReceiveBufferSize min=\"default\" max=\"16MB\"/>"
    "</Internal></Domain></CycloneDDS>";

/// Guards creation and end of domains: Cyclone DDS refuses to create one that still exists.
std::mutex domains_mutex;

std::string configuration() {
  const char* uri = std::getenv("CYCLONEDDS_URI");
  // What stands later overrides.
  return uri == nullptr ? kDefaults : std::string(kDefaults) + "," + uri;
}

Error cannot_join(int domain, dds_return_t code) {
  return {dds_error("domain " + std::to_string(domain), code).message +
          "; is a network interface up, and CYCLONEDDS_URI, if set, valid?"};
}

/// The domain as all of this process share it; empty when somebody else created it.
Result<std::shared_ptr<Entity>> share_domain(int number) {
  static std::map<int, std::weak_ptr<Entity>> domains;
  const std::lock_guard lock(domains_mutex);
  auto& known = domains[number];
  if (auto domain = known.lock()) return domain;
  const auto handle =
      dds_create_domain(static_cast<dds_domainid_t>(number), configuration().c_str());
  if (handle == DDS_RETCODE_PRECONDITION_NOT_MET) return nullptr;
  if (handle < 0) return tl::unexpected(cannot_join(number, handle));
  const std::shared_ptr<Entity> domain(new Entity(handle), [](const Entity* ended) {
    const std::lock_guard deletion(domains_mutex);
    delete ended;
  });
  known = domain;
  return domain;
}

}  // namespace

Result<Participant> Participant::join(int domain) {
  if (domain < 0 || domain > kMaxDomain) {
    return fail("DDS domain " + std::to_string(domain) + ": out of range, 0 to " +
                std::to_string(kMaxDomain));
  }
  auto shared = share_domain(domain);
  if (!shared) return tl::unexpected(shared.error());
  Participant participant;
  participant.domain_ = std::move(*shared);
  const auto handle = dds_create_participant(static_cast<dds_domainid_t>(domain), nullptr, nullptr);
  if (handle < 0) return tl::unexpected(cannot_join(domain, handle));
  participant.entity_ = Entity(handle);
  return participant;
}

void Participant::leave() {
  entity_.reset();
  domain_.reset();
}

}  // namespace orbwatch::app
