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

/// UTC.
struct ValidityPeriod {
  std::chrono::sys_seconds from{};
  std::chrono::sys_seconds until{};
};

/// A moment by a format of strftime().
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

/// A new P-256 key with a certificate of subject CN=`name`, signed by `issuer`, or by itself when
/// there is none. `hosts`: names and numeric addresses of a server. Error: OpenSSL refuses, out of
/// entropy for example.
Result<Credential> make_credential(const std::string& name, CertificateUse use,
                                   const ValidityPeriod& validity,
                                   const Credential* issuer = nullptr,
                                   const std::vector<std::string>& hosts = {});

/// PEM, the key as PKCS #8 without a password.
Result<std::string> to_pem(const Certificate& certificate);
Result<std::string> to_pem(const Key& key);
/// The first one of a PEM text. Error: there is none.
Result<Certificate> certificate_from_pem(std::string_view pem);
/// Error: there is none, or it has a password.
Result<Key> key_from_pem(std::string_view pem);

/// RFC 2253, "CN=subscriber", as in permissions.
std::string subject_of(const Certificate& certificate);
/// Error: a date that no calendar has.
Result<ValidityPeriod> validity_of(const Certificate& certificate);
/// Whether `certificate` was issued by `authority`; dates are not checked.
bool is_issued_by(const Certificate& certificate, const Certificate& authority);
bool is_key_of(const Key& key, const Certificate& certificate);
/// Whether a server with this name or numeric address may show it (RFC 9110, 4.3.4).
bool is_for_host(const Certificate& certificate, const std::string& host);
/// SHA-256 as browsers show it: "01:23:AB...".
std::string fingerprint_of(const Certificate& certificate);

}  // namespace orbwatch::app
