#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "app/dds/security/permissions.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// What a keystore is to be made for.
struct KeystoreRequest {
  std::filesystem::path folder;
  DomainRange domains;
  int days = 3650;  ///< for how long all of it is valid, at most as long as its authorities are
  TopicAccess appliance;
  TopicAccess subscriber;
  std::vector<std::string> bulk_topics;  ///< see governance_document()
  /// None: one of the name "subscriber", in a new keystore.
  std::vector<std::string> subscribers{};
  bool replace = false;  ///< make anew what is there: these subscribers, or all when none is named
};

/// The enclave that is always there.
inline constexpr const char* kApplianceEnclave = "appliance";

/// Where a keystore has the files of a participant, see EnclaveFiles. Beside the enclaves, in
/// private/, are the keys of two authorities: one issues certificates, one signs governance and
/// permissions. With one for both, every participant could write its own permissions, as Cyclone
/// DDS up to 0.10.2 and other products of its time let everybody sign who has a certificate of the
/// authority (CVE-2023-24011).
std::filesystem::path enclave_folder(const std::filesystem::path& keystore,
                                     const std::string& name);

/// Makes a keystore, or adds subscribers to one. Returns the folders of the new enclaves. Each new
/// folder appears whole or not at all; private keys are readable to the owner only. Errors: a name
/// that is none or is there already, a folder that holds something else or was made for other
/// topics or other domains, what the system says to new files.
Result<std::vector<std::filesystem::path>> make_keys(const KeystoreRequest& request,
                                                     std::chrono::sys_seconds now);

}  // namespace orbwatch::app
