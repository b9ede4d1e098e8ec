// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/ports/dds/security/access_documents.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli {

/// Rights that orbwatchd needs for these topics.
dds::TopicAccess appliance_access(std::string_view prefix);

/// Rights of its readers, and of readers that also send commands.
dds::TopicAccess reader_access(std::string_view prefix);
dds::TopicAccess controller_access(std::string_view prefix);

/// Topics of pictures.
std::vector<std::string> bulk_topics(std::string_view prefix);

/// Contents of a keystore.
struct KeystoreRequest {
  std::filesystem::path folder;
  dds::DomainRange domains;
  int days = 3650;  ///< days of validity, at most those of the authorities
  dds::TopicAccess appliance;
  dds::TopicAccess subscriber;
  std::vector<std::string> bulk_topics;  ///< see governance_document()
  /// Empty: one subscriber named "subscriber", in a new keystore.
  std::vector<std::string> subscribers{};
  bool replace =
      false;  ///< replaces existing keys: of these subscribers, or of all when none is named
};

/// Enclave that every keystore has.
inline constexpr const char* kApplianceEnclave = "appliance";

/// Folder of a participant's files in a keystore, see EnclaveFiles. Beside the enclaves, private/
/// holds the keys of two authorities: one issues certificates, one signs governance and
/// permissions. With a single authority every participant could sign its own permissions: Cyclone
/// DDS up to 0.10.2, among others, accepts signatures of any certificate of the authority
/// (CVE-2023-24011).
std::filesystem::path enclave_folder(const std::filesystem::path& keystore,
                                     const std::string& name);

/// Makes a keystore, or adds subscribers to one. Returns the folders of the new enclaves. Each new
/// folder appears complete or not at all; private keys are readable by the owner only. Errors: an
/// invalid or existing name, a folder with other content or made for other topics or domains, I/O
/// errors.
Result<std::vector<std::filesystem::path>> make_keys(const KeystoreRequest& request,
                                                     std::chrono::sys_seconds now);

}  // namespace orbwatch::app::cli
