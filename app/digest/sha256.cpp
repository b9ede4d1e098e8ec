// SPDX-License-Identifier: Apache-2.0
#include "app/digest/sha256.h"

#include <sodium.h>

#include <array>
#include <fstream>

namespace orbwatch::app {

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

std::string sha256(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.digits();
}

Result<std::string> sha256_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string part(std::size_t{1} << 16, '\0');
  Sha256 hash;
  while (in.read(part.data(), static_cast<std::streamsize>(part.size())) || in.gcount() > 0) {
    hash.add(std::string_view(part).substr(0, static_cast<std::size_t>(in.gcount())));
  }
  if (!in.eof()) return fail(file.string() + ": cannot be read");
  return hash.digits();
}

}  // namespace orbwatch::app
