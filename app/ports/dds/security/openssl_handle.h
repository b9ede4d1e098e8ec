#pragma once

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>

#include <memory>
#include <string>
#include <string_view>

#include "proc/image/result.h"

namespace orbwatch::app {

/// Releases an object of OpenSSL's C API by its own function.
template <auto release>
struct OpensslDeleter {
  template <class Object>
  void operator()(Object* object) const {
    release(object);
  }
};

using Key = std::unique_ptr<EVP_PKEY, OpensslDeleter<EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, OpensslDeleter<X509_free>>;
using Bio = std::unique_ptr<BIO, OpensslDeleter<BIO_free_all>>;
using Pkcs7 = std::unique_ptr<PKCS7, OpensslDeleter<PKCS7_free>>;

/// The error of an OpenSSL call that just failed on this thread: "<what>: <OpenSSL's reason>".
Error openssl_error(std::string_view what);

/// Reads from `text`, which must live as long.
Bio read_bio(std::string_view text);
/// Writes to memory that grows.
Bio write_bio();
/// The text written so far.
std::string text_of(const Bio& bio);

}  // namespace orbwatch::app
