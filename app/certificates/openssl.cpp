// SPDX-License-Identifier: Apache-2.0
#include "app/certificates/openssl.h"

#include <openssl/err.h>

namespace orbwatch::app {

Bio read_bio(std::string_view text) {
  return Bio(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

Bio write_bio() { return Bio(BIO_new(BIO_s_mem())); }

std::string text_of(const Bio& bio) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(bio.get(), &data);
  return size > 0 ? std::string(data, static_cast<std::size_t>(size)) : std::string();
}

Error openssl_error(std::string_view what) {
  const char* reason = ERR_reason_error_string(ERR_peek_last_error());
  ERR_clear_error();
  return {std::string(what) + ": " + (reason ? reason : "OpenSSL states no reason")};
}

}  // namespace orbwatch::app
