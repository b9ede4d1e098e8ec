#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "app/dds/security/certificate.h"
#include "app/dds/security/permissions.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// The files of one participant, named as in an enclave of ROS 2, so that the folder serves there
/// too. The XML beside the signed documents is for people only.
struct EnclaveFiles {
  explicit EnclaveFiles(const std::filesystem::path& folder);

  std::filesystem::path identity_ca;     ///< who issues certificates
  std::filesystem::path permissions_ca;  ///< who signs governance and permissions
  std::filesystem::path certificate;
  std::filesystem::path key;
  std::filesystem::path governance;   ///< the same for all participants of a domain
  std::filesystem::path permissions;  ///< what this participant may do
};

/// The text of a signed document in a file. Errors: name the file and say what is wrong.
Result<std::string> read_document(const std::filesystem::path& file, const Certificate& signer);
Result<Certificate> read_certificate(const std::filesystem::path& file);
/// Refuses a key that everybody on the computer may read.
Result<Key> read_key(const std::filesystem::path& file);

/// Finds what would keep a participant with these files out of a domain, or others from talking to
/// it, while there still is a file to name: Cyclone DDS does not look at all of it, and says
/// little. Errors: a file that is missing, damaged, expired at `now`, not valid yet, or does not
/// fit the others or the domain. Reentrant.
Result<> check_enclave(const EnclaveFiles& files, int domain, std::chrono::sys_seconds now);

}  // namespace orbwatch::app
