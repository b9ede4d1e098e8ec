// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <openssl/evp.h>
#include <openssl/x509.h>

#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/certificates/openssl.h"
#include "proc/image/result.h"

/// Keys and certificates by OpenSSL. All reentrant.
namespace orbwatch::app {

using Key = std::unique_ptr<EVP_PKEY, OpensslDeleter<EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, OpensslDeleter<X509_free>>;

/// Period of validity, UTC.
struct ValidityPeriod {
  std::chrono::sys_seconds from{};
  std::chrono::sys_seconds until{};
};

/// Formats a moment by strftime().
std::string date_text(std::chrono::sys_seconds time, const char* format);

/// A key with its certificate.
struct Credential {
  Key key;
  Certificate certificate;
};

/// The use of the key of a certificate.
enum class CertificateUse {
  IssueIdentities,  ///< signs certificates, itself included
  SignDocuments,    ///< signs governance and permissions, and its own certificate
  Authenticate,     ///< authenticates a participant; its signature on anything else is void
  Serve             ///< authenticates a server
};

/// A new P-256 key with a certificate of subject CN=`name`, signed by `issuer`, or self-signed if
/// that is null. `hosts`: names and numeric addresses of a server. Error: a failure of OpenSSL, for
/// example for lack of entropy.
Result<Credential> make_credential(const std::string& name, CertificateUse use,
                                   const ValidityPeriod& validity,
                                   const Credential* issuer = nullptr,
                                   const std::vector<std::string>& hosts = {});

/// Text in PEM, the key as PKCS #8 without a password.
Result<std::string> to_pem(const Certificate& certificate);
Result<std::string> to_pem(const Key& key);
/// The first certificate of a PEM text. Error: it has none.
Result<Certificate> certificate_from_pem(std::string_view pem);
/// The first private key of a PEM text. Error: it has none, or the key has a password.
Result<Key> key_from_pem(std::string_view pem);

/// Subject in the form of RFC 2253, "CN=subscriber", as in permissions.
std::string subject_of(const Certificate& certificate);
/// Error: an invalid date.
Result<ValidityPeriod> validity_of(const Certificate& certificate);
/// Returns whether `authority` issued `certificate`; dates are not checked.
bool is_issued_by(const Certificate& certificate, const Certificate& authority);
bool is_key_of(const Key& key, const Certificate& certificate);
/// Returns whether a server with this name or numeric address may present it (RFC 9110, 4.3.4).
bool is_for_host(const Certificate& certificate, const std::string& host);
/// SHA-256 in the form that browsers show: "01:23:AB...".
std::string fingerprint_of(const Certificate& certificate);

}  // namespace orbwatch::app
