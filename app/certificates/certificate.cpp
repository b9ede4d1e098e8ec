// SPDX-License-Identifier: Apache-2.0
#include "app/certificates/certificate.h"

#include <openssl/bn.h>
#include <openssl/ec.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <optional>

#include "hal/calendar_time.h"

namespace orbwatch::app {
namespace {

using Extension = std::unique_ptr<X509_EXTENSION, OpensslDeleter<X509_EXTENSION_free>>;
using GeneralName = std::unique_ptr<GENERAL_NAME, OpensslDeleter<GENERAL_NAME_free>>;
using GeneralNames = std::unique_ptr<GENERAL_NAMES, OpensslDeleter<GENERAL_NAMES_free>>;
using BigNumber = std::unique_ptr<BIGNUM, OpensslDeleter<BN_free>>;
using Store = std::unique_ptr<X509_STORE, OpensslDeleter<X509_STORE_free>>;
using StoreContext = std::unique_ptr<X509_STORE_CTX, OpensslDeleter<X509_STORE_CTX_free>>;

/// RFC 5280 allows 20 octets and requires a positive number.
constexpr int kSerialBits = 159;
constexpr long kVersion3 = 2;

struct ExtensionText {
  int nid;
  const char* value;  ///< in OpenSSL's configuration language, x509v3_config(5)
};

/// Extensions by RFC 5280, 4.2.1. A signer of documents need not issue certificates, but verifiers
/// look up its own certificate as an issuer's.
std::vector<ExtensionText> extensions_for(CertificateUse use) {
  switch (use) {
    case CertificateUse::IssueIdentities:
      return {{NID_basic_constraints, "critical,CA:TRUE,pathlen:0"},
              {NID_key_usage, "critical,keyCertSign,cRLSign"},
              {NID_subject_key_identifier, "hash"}};
    case CertificateUse::SignDocuments:
      return {{NID_basic_constraints, "critical,CA:TRUE,pathlen:0"},
              {NID_key_usage, "critical,keyCertSign,digitalSignature"},
              {NID_subject_key_identifier, "hash"}};
    case CertificateUse::Serve:
      return {{NID_basic_constraints, "critical,CA:FALSE"},
              {NID_key_usage, "critical,digitalSignature"},
              {NID_ext_key_usage, "serverAuth"},
              {NID_subject_key_identifier, "hash"}};
    case CertificateUse::Authenticate:
      break;
  }
  return {{NID_basic_constraints, "critical,CA:FALSE"},
          {NID_key_usage, "critical,digitalSignature"},
          {NID_ext_key_usage, "clientAuth,serverAuth"}};
}

bool add_extension(X509* certificate, X509* issuer, const ExtensionText& text) {
  X509V3_CTX context;
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  const Extension extension(X509V3_EXT_nconf_nid(nullptr, &context, text.nid, text.value));
  return extension && X509_add_ext(certificate, extension.get(), -1) == 1;
}

bool add_host(GENERAL_NAMES* names, const std::string& host) {
  ASN1_OCTET_STRING* const address = a2i_IPADDRESS(host.c_str());
  ASN1_STRING* const text = address ? address : ASN1_IA5STRING_new();
  GeneralName name(GENERAL_NAME_new());
  if (!text || !name) {
    ASN1_STRING_free(text);
    return false;
  }
  GENERAL_NAME_set0_value(name.get(), address ? GEN_IPADD : GEN_DNS, text);
  if (!address && ASN1_STRING_set(text, host.data(), static_cast<int>(host.size())) != 1) {
    return false;
  }
  if (sk_GENERAL_NAME_push(names, name.get()) < 1) return false;
  static_cast<void>(name.release());
  return true;
}

/// Adds subject alternative names (RFC 5280, 4.2.1.6).
bool add_hosts(X509* certificate, const std::vector<std::string>& hosts) {
  if (hosts.empty()) return true;
  const GeneralNames names(sk_GENERAL_NAME_new_null());
  return names &&
         std::ranges::all_of(hosts,
                             [&](const auto& host) { return add_host(names.get(), host); }) &&
         X509_add1_ext_i2d(certificate, NID_subject_alt_name, names.get(), 0, 0) == 1;
}

bool set_serial(X509* certificate) {
  const BigNumber serial(BN_new());
  return serial && BN_rand(serial.get(), kSerialBits, BN_RAND_TOP_ONE, BN_RAND_BOTTOM_ANY) == 1 &&
         BN_to_ASN1_INTEGER(serial.get(), X509_get_serialNumber(certificate));
}

bool set_subject(X509* certificate, const std::string& name) {
  const auto* const text = reinterpret_cast<const unsigned char*>(name.data());
  return X509_NAME_add_entry_by_NID(X509_get_subject_name(certificate), NID_commonName,
                                    MBSTRING_UTF8, text, static_cast<int>(name.size()), -1, 0) == 1;
}

bool set_validity(X509* certificate, const ValidityPeriod& validity) {
  // Days since 1970, because time_t may have 32 bits.
  const auto set = [](ASN1_TIME* field, std::chrono::sys_seconds time) {
    const auto day = std::chrono::floor<std::chrono::days>(time);
    return ASN1_TIME_adj(field, 0, static_cast<int>(day.time_since_epoch().count()),
                         static_cast<long>((time - day).count())) != nullptr;
  };
  return set(X509_getm_notBefore(certificate), validity.from) &&
         set(X509_getm_notAfter(certificate), validity.until);
}

std::optional<std::chrono::sys_seconds> time_of(const ASN1_TIME* time) {
  std::tm calendar{};
  if (ASN1_TIME_to_tm(time, &calendar) != 1) return std::nullopt;
  return hal::moment_of(calendar);
}

/// Replaces OpenSSL's prompt on the terminal.
int no_password(char*, int, int, void*) { return 0; }

}  // namespace

std::string date_text(std::chrono::sys_seconds time, const char* format) {
  const std::tm calendar = hal::calendar_time(time);
  char text[32];
  return {text, std::strftime(text, sizeof text, format, &calendar)};
}

Result<Credential> make_credential(const std::string& name, CertificateUse use,
                                   const ValidityPeriod& validity, const Credential* issuer,
                                   const std::vector<std::string>& hosts) {
  Credential made{Key(EVP_PKEY_Q_keygen(nullptr, nullptr, "EC", "P-256")), Certificate(X509_new())};
  X509* const certificate = made.certificate.get();
  if (!made.key || !certificate) return tl::unexpected(openssl_error("no new key"));
  X509* const issuer_certificate = issuer ? issuer->certificate.get() : certificate;
  bool good = X509_set_version(certificate, kVersion3) == 1 && set_serial(certificate) &&
              set_subject(certificate, name) && set_validity(certificate, validity) &&
              X509_set_issuer_name(certificate, X509_get_subject_name(issuer_certificate)) == 1 &&
              X509_set_pubkey(certificate, made.key.get()) == 1;
  for (const ExtensionText& extension : extensions_for(use)) {
    good = good && add_extension(certificate, issuer_certificate, extension);
  }
  good = good &&
         add_extension(certificate, issuer_certificate,
                       {NID_authority_key_identifier, "keyid:always"}) &&
         add_hosts(certificate, hosts);
  EVP_PKEY* const signer = issuer ? issuer->key.get() : made.key.get();
  if (!good || X509_sign(certificate, signer, EVP_sha256()) == 0) {
    return tl::unexpected(openssl_error("no certificate for " + name));
  }
  return made;
}

Result<std::string> to_pem(const Certificate& certificate) {
  const Bio out = write_bio();
  if (out && PEM_write_bio_X509(out.get(), certificate.get()) == 1) return text_of(out);
  return tl::unexpected(openssl_error("certificate cannot be written"));
}

Result<std::string> to_pem(const Key& key) {
  const Bio out = write_bio();
  if (out && PEM_write_bio_PKCS8PrivateKey(out.get(), key.get(), nullptr, nullptr, 0, nullptr,
                                           nullptr) == 1) {
    return text_of(out);
  }
  return tl::unexpected(openssl_error("key cannot be written"));
}

Result<Certificate> certificate_from_pem(std::string_view pem) {
  const Bio in = read_bio(pem);
  Certificate certificate(in ? PEM_read_bio_X509(in.get(), nullptr, nullptr, nullptr) : nullptr);
  if (!certificate) return tl::unexpected(openssl_error("is not a certificate in PEM"));
  return certificate;
}

Result<Key> key_from_pem(std::string_view pem) {
  const Bio in = read_bio(pem);
  Key key(in ? PEM_read_bio_PrivateKey(in.get(), nullptr, no_password, nullptr) : nullptr);
  if (!key) return tl::unexpected(openssl_error("is not a private key in PEM without a password"));
  return key;
}

std::string subject_of(const Certificate& certificate) {
  const Bio out = write_bio();
  X509_NAME_print_ex(out.get(), X509_get_subject_name(certificate.get()), 0, XN_FLAG_RFC2253);
  return text_of(out);
}

Result<ValidityPeriod> validity_of(const Certificate& certificate) {
  const auto from = time_of(X509_get0_notBefore(certificate.get()));
  const auto until = time_of(X509_get0_notAfter(certificate.get()));
  if (!from || !until) return fail("has no valid dates");
  return ValidityPeriod{*from, *until};
}

bool is_issued_by(const Certificate& certificate, const Certificate& authority) {
  const Store store(X509_STORE_new());
  const StoreContext context(X509_STORE_CTX_new());
  if (!store || !context || X509_STORE_add_cert(store.get(), authority.get()) != 1 ||
      X509_STORE_CTX_init(context.get(), store.get(), certificate.get(), nullptr) != 1) {
    return false;
  }
  X509_STORE_CTX_set_flags(context.get(), X509_V_FLAG_NO_CHECK_TIME);
  return X509_verify_cert(context.get()) == 1;
}

bool is_key_of(const Key& key, const Certificate& certificate) {
  return X509_check_private_key(certificate.get(), key.get()) == 1;
}

bool is_for_host(const Certificate& certificate, const std::string& host) {
  X509* const x509 = certificate.get();
  return X509_check_ip_asc(x509, host.c_str(), 0) == 1 ||
         X509_check_host(x509, host.data(), host.size(), X509_CHECK_FLAG_NEVER_CHECK_SUBJECT,
                         nullptr) == 1;
}

std::string fingerprint_of(const Certificate& certificate) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  X509_digest(certificate.get(), EVP_sha256(), digest.data(), &size);
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string text;
  for (unsigned i = 0; i < size; ++i) {
    if (i > 0) text += ':';
    text += kDigits[digest.at(i) >> 4U];
    text += kDigits[digest.at(i) & 15U];
  }
  return text;
}

}  // namespace orbwatch::app
