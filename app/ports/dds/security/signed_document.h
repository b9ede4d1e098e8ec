#pragma once

#include <string>
#include <string_view>

#include "app/certificates/certificate.h"
#include "proc/image/result.h"

/// Signatures of governance and permissions. All reentrant.
namespace orbwatch::app {

/// `text` as S/MIME multipart/signed with a detached PKCS #7 signature, as DDS
/// Security 1.1, 9.4.1.2, requires of governance and permissions.
Result<std::string> sign_document(std::string_view text, const Credential& signer);

/// The text of a signed document. Only the key of `signer` is trusted, not one whose
/// certificate it issued or that the document contains. Errors: not S/MIME; not signed by
/// `signer`, or changed afterwards.
Result<std::string> verified_document(std::string_view document, const Certificate& signer);

}  // namespace orbwatch::app
