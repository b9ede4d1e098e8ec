// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/sha256.h"

#include <sodium.h>

#include <array>

namespace orbwatch::app::web {

struct Sha256::State {
  crypto_hash_sha256_state hash;
};

Sha256::Sha256() : state_(std::make_unique<State>()) { restart(); }
Sha256::~Sha256() = default;

void Sha256::restart() { ::crypto_hash_sha256_init(&state_->hash); }

void Sha256::add(std::string_view bytes) {
  ::crypto_hash_sha256_update(&state_->hash, reinterpret_cast<const unsigned char*>(bytes.data()),
                              bytes.size());
}

std::string Sha256::digits() const {
  crypto_hash_sha256_state ended = state_->hash;
  std::array<unsigned char, crypto_hash_sha256_BYTES> hash{};
  ::crypto_hash_sha256_final(&ended, hash.data());
  std::string text(2 * hash.size() + 1, '\0');
  ::sodium_bin2hex(text.data(), text.size(), hash.data(), hash.size());
  text.pop_back();  // removes the terminating zero
  return text;
}

}  // namespace orbwatch::app::web
