// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "app/certificates/certificate.h"
#include "proc/image/result.h"

/// Signatures of governance and permissions. All reentrant.
namespace orbwatch::app::dds {

/// Signs `text` as S/MIME multipart/signed with a detached PKCS #7 signature, required by DDS
/// Security 1.1, 9.4.1.2, for governance and permissions.
Result<std::string> sign_document(std::string_view text, const Credential& signer);

/// Verifies a signed document and returns its text. Only the key of `signer` is trusted, not keys
/// whose certificate it issued or that the document contains. Errors: not S/MIME; not signed by
/// `signer`, or changed afterwards.
Result<std::string> verified_document(std::string_view document, const Certificate& signer);

}  // namespace orbwatch::app::dds
