// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/security/signed_document.h"

#include <openssl/pkcs7.h>

#include <memory>

#include "app/certificates/openssl.h"

namespace orbwatch::app::dds {
namespace {

using Pkcs7 = std::unique_ptr<PKCS7, OpensslDeleter<PKCS7_free>>;

/// Stack that does not own its certificates.
using Certificates =
    std::unique_ptr<STACK_OF(X509),
                    OpensslDeleter<[](STACK_OF(X509) * stack) { sk_X509_free(stack); }>>;

}  // namespace

Result<std::string> sign_document(std::string_view text, const Credential& signer) {
  constexpr int kFlags = PKCS7_TEXT | PKCS7_DETACHED | PKCS7_STREAM;
  const Bio in = read_bio(text);
  const Bio out = write_bio();
  const Pkcs7 signature(
      PKCS7_sign(signer.certificate.get(), signer.key.get(), nullptr, in.get(), kFlags));
  if (!in || !out || !signature ||
      SMIME_write_PKCS7(out.get(), signature.get(), in.get(), kFlags) != 1) {
    return tl::unexpected(openssl_error("document cannot be signed"));
  }
  return text_of(out);
}

Result<std::string> verified_document(std::string_view document, const Certificate& signer) {
  const Bio in = read_bio(document);
  BIO* found = nullptr;
  const Pkcs7 signature(in ? SMIME_read_PKCS7(in.get(), &found) : nullptr);
  const Bio content(found);
  if (!signature || !content)
    return tl::unexpected(openssl_error("is not a signed S/MIME document"));
  const Certificates signers(sk_X509_new_null());
  const Bio out = write_bio();
  if (!out || !signers || sk_X509_push(signers.get(), signer.get()) < 1) {
    return tl::unexpected(openssl_error("cannot be verified"));
  }
  // The signer is known in advance: neither certificates in the document nor a chain are used.
  constexpr int kFlags = PKCS7_TEXT | PKCS7_NOVERIFY | PKCS7_NOINTERN;
  if (PKCS7_verify(signature.get(), signers.get(), nullptr, content.get(), out.get(), kFlags) !=
      1) {
    return tl::unexpected(openssl_error("bad signature"));
  }
  return text_of(out);
}

}  // namespace orbwatch::app::dds
