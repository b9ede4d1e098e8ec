// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <openssl/ssl.h>

#include <csignal>
#include <memory>
#include <string>

#include "app/certificates/certificate.h"
#include "tests/app/ports/web/http_client.h"

namespace orbwatch::app::web::tests {

/// A TLS client by another library than the server's. Trusts every certificate, and records the
/// presented one.
class TlsClient : public Client {
 public:
  /// `newest`: newest supported version of TLS; 0: any. `ciphers`: ciphers of TLS 1.2 by OpenSSL's
  /// names; null: any.
  explicit TlsClient(int port, const char* host = "127.0.0.1", int newest = 0,
                     int receive_buffer = 0, const char* ciphers = nullptr)
      : Client(port, receive_buffer, host), context_(SSL_CTX_new(TLS_client_method())) {
    // Writing to a closed server must not end the test.
    std::signal(SIGPIPE, SIG_IGN);
    // Overrides this computer's configuration for old versions.
    SSL_CTX_set_security_level(context_.get(), 0);
    SSL_CTX_set_min_proto_version(context_.get(), TLS1_VERSION);
    SSL_CTX_set_max_proto_version(context_.get(), newest);
    if (ciphers) {
      EXPECT_EQ(SSL_CTX_set_cipher_list(context_.get(), ciphers), 1);
    }
    tls_.reset(SSL_new(context_.get()));
    SSL_set_fd(tls_.get(), get());
    is_secure_ = SSL_connect(tls_.get()) == 1;
  }

  /// Returns whether the TLS connection is established.
  bool is_secure() const { return is_secure_; }
  std::string version() const { return SSL_get_version(tls_.get()); }
  Certificate certificate() const { return Certificate(SSL_get1_peer_certificate(tls_.get())); }
  std::string fingerprint() const { return fingerprint_of(certificate()); }
  /// Number of certificates that the server sent.
  int chain_length() const { return sk_X509_num(SSL_get_peer_cert_chain(tls_.get())); }

 protected:
  ssize_t write(std::string_view bytes) const override {
    return SSL_write(tls_.get(), bytes.data(), static_cast<int>(bytes.size()));
  }
  ssize_t read(std::span<char> out) override {
    return SSL_read(tls_.get(), out.data(), static_cast<int>(out.size()));
  }

 private:
  std::unique_ptr<SSL_CTX, OpensslDeleter<SSL_CTX_free>> context_;
  std::unique_ptr<SSL, OpensslDeleter<SSL_free>> tls_;
  bool is_secure_ = false;
};

/// One request over a connection of its own.
inline Answer tls_request(int port, std::string_view method, std::string_view target,
                          const std::string& headers = "", std::string_view body = "",
                          const char* host = "127.0.0.1") {
  TlsClient client(port, host);
  EXPECT_TRUE(client.is_secure());
  client.send(request_text(method, target, headers, body));
  return client.answer(method != "HEAD");
}

}  // namespace orbwatch::app::web::tests
