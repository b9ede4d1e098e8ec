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
/// system grants net.core.rmem_max at most. To end a thread that receives alone Cyclone DDS sends a
/// packet to its own address, and waits for ever when that is gone; one that serves all sockets is
/// told by other means.
constexpr const char* kDefaults =
    "<CycloneDDS><Domain><Internal><MultipleReceiveThreads>false</MultipleReceiveThreads>"
    "<SocketReceiveBufferSize min=\"default\" max=\"16MB\"/>"
    "</Internal></Domain></CycloneDDS>";

/// Guards creation and end of domains: Cyclone DDS refuses to create one that still exists.
std::mutex domains_mutex;

std::string configuration(const std::filesystem::path& profile) {
  // What stands later overrides.
  if (!profile.empty()) return std::string(kDefaults) + ",file://" + profile.string();
  const char* uri = std::getenv("CYCLONEDDS_URI");
  return uri == nullptr ? kDefaults : std::string(kDefaults) + "," + uri;
}

Error cannot_join(int domain, dds_return_t code) {
  return {dds_error("domain " + std::to_string(domain), code).message +
          "; is a network interface up, and the profile or CYCLONEDDS_URI, if set, valid?"};
}

/// For the rest of what plugins look at; they log it.
Error refused_by_plugins(int domain, const SecuritySettings& security) {
  return {
      dds_error("domain " + std::to_string(domain), DDS_RETCODE_NOT_ALLOWED_BY_SECURITY).message +
      "; do the documents in " + security.folder.string() + " follow DDS Security 1.1?"};
}

/// The domain as all of this process share it; empty when somebody else created it.
Result<std::shared_ptr<Entity>> share_domain(int number, const std::filesystem::path& profile) {
  static std::map<int, std::weak_ptr<Entity>> domains;
  const std::lock_guard lock(domains_mutex);
  auto& known = domains[number];
  if (auto domain = known.lock()) return domain;
  const auto handle =
      dds_create_domain(static_cast<dds_domainid_t>(number), configuration(profile).c_str());
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

Result<> check_domain(int domain) {
  if (domain >= 0 && domain <= kMaxDomain) return {};
  return fail("DDS domain " + std::to_string(domain) + ": out of range, 0 to " +
              std::to_string(kMaxDomain));
}

Result<> check_profile(const std::filesystem::path& profile) {
  if (profile.string().find(',') != std::string::npos) {
    return fail("DDS profile " + profile.string() +
                ": has a comma in its path, which Cyclone DDS takes for the end; rename it");
  }
  std::error_code ignored;  // a file that cannot be looked at is none
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
  auto shared = share_domain(domain, profile);
  if (!shared) return tl::unexpected(shared.error());
  Participant participant;
  participant.domain_ = std::move(*shared);
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
}

}  // namespace orbwatch::app
