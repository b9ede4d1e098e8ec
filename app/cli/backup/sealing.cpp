// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/sealing.h"

#include <sodium.h>

#include <array>
#include <cstring>
#include <optional>

namespace orbwatch::app::cli::backup {
namespace {

// Part of the format of a backup.
constexpr unsigned long long kPasses = 4;
constexpr std::size_t kMemory = std::size_t{64} << 20;

constexpr std::size_t kSalt = crypto_pwhash_argon2id_SALTBYTES;
constexpr std::size_t kHeader = crypto_secretstream_xchacha20poly1305_HEADERBYTES;
constexpr std::size_t kOverhead = crypto_secretstream_xchacha20poly1305_ABYTES;

/// Key of the cipher, erased with this object.
struct CipherKey {
  CipherKey() = default;
  CipherKey(const CipherKey&) = delete;
  CipherKey& operator=(const CipherKey&) = delete;
  ~CipherKey() { ::sodium_memzero(bytes.data(), bytes.size()); }

  std::array<unsigned char, crypto_secretstream_xchacha20poly1305_KEYBYTES> bytes{};
};

const unsigned char* bytes_of(std::string_view text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}
unsigned char* bytes_of(std::string& text) { return reinterpret_cast<unsigned char*>(text.data()); }

bool is_ready() {
  static const bool ready = ::sodium_init() >= 0;
  return ready;
}

Result<> derive(CipherKey& key, std::string_view passphrase, std::string_view salt) {
  if (is_ready() && ::crypto_pwhash_argon2id(key.bytes.data(), key.bytes.size(), passphrase.data(),
                                             passphrase.size(), bytes_of(salt), kPasses, kMemory,
                                             crypto_pwhash_argon2id_ALG_ARGON2ID13) == 0) {
    return {};
  }
  return fail("not enough memory to derive the key from the passphrase");
}

}  // namespace

Result<std::string> seal(std::string_view bytes, std::string_view passphrase,
                         std::string_view context) {
  if (!is_ready()) return fail("libsodium cannot be used");
  std::string sealed(kSalt + kHeader + bytes.size() + kOverhead, '\0');
  ::randombytes_buf(sealed.data(), kSalt);
  CipherKey key;
  const auto derived = derive(key, passphrase, std::string_view(sealed).substr(0, kSalt));
  if (!derived) return tl::unexpected(derived.error());
  crypto_secretstream_xchacha20poly1305_state state;
  ::crypto_secretstream_xchacha20poly1305_init_push(&state, bytes_of(sealed) + kSalt,
                                                    key.bytes.data());
  const int pushed = ::crypto_secretstream_xchacha20poly1305_push(
      &state, bytes_of(sealed) + kSalt + kHeader, nullptr, bytes_of(bytes), bytes.size(),
      bytes_of(context), context.size(), crypto_secretstream_xchacha20poly1305_TAG_FINAL);
  ::sodium_memzero(&state, sizeof state);
  if (pushed != 0) return fail("the secrets are too large to encrypt");
  return sealed;
}

Result<std::string> unseal(std::string_view sealed, std::string_view passphrase,
                           std::string_view context) {
  if (sealed.size() < kSalt + kHeader + kOverhead) return fail("the secrets are cut off");
  CipherKey key;
  const auto derived = derive(key, passphrase, sealed.substr(0, kSalt));
  if (!derived) return tl::unexpected(derived.error());
  const std::string_view cipher = sealed.substr(kSalt + kHeader);
  std::string bytes(cipher.size() - kOverhead, '\0');
  crypto_secretstream_xchacha20poly1305_state state;
  unsigned char tag = 0;
  const bool is_right = ::crypto_secretstream_xchacha20poly1305_init_pull(
                            &state, bytes_of(sealed) + kSalt, key.bytes.data()) == 0 &&
                        ::crypto_secretstream_xchacha20poly1305_pull(
                            &state, bytes_of(bytes), nullptr, &tag, bytes_of(cipher), cipher.size(),
                            bytes_of(context), context.size()) == 0 &&
                        tag == crypto_secretstream_xchacha20poly1305_TAG_FINAL;
  ::sodium_memzero(&state, sizeof state);
  if (is_right) return bytes;
  return fail("the passphrase is wrong, or the file was changed");
}

}  // namespace orbwatch::app::cli::backup
