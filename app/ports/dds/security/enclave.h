// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "app/certificates/certificate_file.h"
#include "app/ports/dds/security/access_documents.h"
#include "proc/image/result.h"

namespace orbwatch::app::dds {

/// Files of one participant, named as in an enclave of ROS 2, which can use the folder, too. The
/// XML beside the signed documents is for reading by users only.
struct EnclaveFiles {
  explicit EnclaveFiles(const std::filesystem::path& folder);

  std::filesystem::path identity_ca;     ///< issues certificates
  std::filesystem::path permissions_ca;  ///< signs governance and permissions
  std::filesystem::path certificate;
  std::filesystem::path key;
  std::filesystem::path governance;   ///< the same for all participants of a domain
  std::filesystem::path permissions;  ///< rights of this participant
};

/// Reads and verifies a signed document from a file; returns its text. Errors name file and reason.
Result<std::string> read_document(const std::filesystem::path& file, const Certificate& signer);

/// Checks that a participant with these files can join the domain and be authenticated. Cyclone DDS
/// checks less and does not name the file. Errors: a file that is missing, damaged, expired at
/// `now`, not valid yet, or inconsistent with the others or the domain. Without `now` dates are not
/// checked. Reentrant.
Result<> check_enclave(const EnclaveFiles& files, int domain, const Now& now);

}  // namespace orbwatch::app::dds
