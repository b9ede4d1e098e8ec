// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <openssl/bio.h>

#include <memory>
#include <string>
#include <string_view>

#include "proc/image/result.h"

/// OpenSSL's C API in C++. All reentrant.
namespace orbwatch::app {

/// Releases an object of OpenSSL's C API by its own function.
template <auto release>
struct OpensslDeleter {
  template <class Object>
  void operator()(Object* object) const {
    release(object);
  }
};

using Bio = std::unique_ptr<BIO, OpensslDeleter<BIO_free_all>>;

/// Reads from `text`, which must outlive the result.
Bio read_bio(std::string_view text);
/// Writes to memory that grows.
Bio write_bio();
/// The text written so far.
std::string text_of(const Bio& bio);

/// The error of an OpenSSL call that just failed on this thread: "<what>: <OpenSSL's reason>".
Error openssl_error(std::string_view what);

}  // namespace orbwatch::app
