// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/login/secret.h"

#include <sodium.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace orbwatch::app::web {
namespace {

/// Ends the process if the library cannot be initialised, because nothing here is secure without
/// its random numbers.
void need_library() {
  static const bool is_ready = ::sodium_init() >= 0;
  if (!is_ready) std::abort();
}

template <std::size_t N>
std::string as_text(const std::array<unsigned char, N>& bytes) {
  constexpr int kVariant = sodium_base64_VARIANT_URLSAFE_NO_PADDING;
  std::string text(sodium_base64_ENCODED_LEN(N, kVariant), '\0');
  ::sodium_bin2base64(text.data(), text.size(), bytes.data(), N, kVariant);
  text.pop_back();  // removes the terminating zero
  return text;
}

/// Number of characters in UTF-8: bytes that begin one.
std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// A hash with the parameters of hash_password() that no known password has, for unknown names, so
/// that they take as long as known ones. A constant, because hashing fails without free memory.
constexpr const char* kHashOfNobody =
    "$argon2id$v=19$m=65536,t=2,p=1$AAAAAAAAAAAAAAAAAAAAAA"
    "$AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA";
static_assert(crypto_pwhash_OPSLIMIT_INTERACTIVE == 2);
static_assert(crypto_pwhash_MEMLIMIT_INTERACTIVE == 65536U * 1024U);

/// Allocates as libsodium does for a hash.
bool has_memory_for_hash() {
  void* const memory = ::mmap(nullptr, crypto_pwhash_MEMLIMIT_INTERACTIVE, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return memory != MAP_FAILED && ::munmap(memory, crypto_pwhash_MEMLIMIT_INTERACTIVE) == 0;
}

}  // namespace

Result<> check_password(std::string_view password) {
  if (characters(password) < kLeastPasswordCharacters) {
    return fail("the password has " + std::to_string(characters(password)) +
                " characters; it must have at least " + std::to_string(kLeastPasswordCharacters));
  }
  if (password.size() > kMostPasswordBytes) {
    return fail("the password has more than " + std::to_string(kMostPasswordBytes) + " bytes");
  }
  return {};
}

Result<std::string> hash_password(std::string_view password) {
  need_library();
  std::array<char, crypto_pwhash_STRBYTES> hash{};
  if (::crypto_pwhash_str(hash.data(), password.data(), password.size(),
                          crypto_pwhash_OPSLIMIT_INTERACTIVE,
                          crypto_pwhash_MEMLIMIT_INTERACTIVE) != 0) {
    return fail("the password cannot be hashed: less than 64 MiB of memory is free");
  }
  return std::string(hash.data());
}

/// libsodium 1.0.18 has one result for another password and for want of memory.
PasswordMatch match_password(const std::string& hash, std::string_view password) {
  need_library();
  const char* compared = hash.empty() ? kHashOfNobody : hash.c_str();
  if (::crypto_pwhash_str_verify(compared, password.data(), password.size()) == 0) {
    return hash.empty() ? PasswordMatch::Wrong : PasswordMatch::Right;
  }
  return has_memory_for_hash() ? PasswordMatch::Wrong : PasswordMatch::OutOfMemory;
}

std::string random_token() {
  need_library();
  std::array<unsigned char, 32> bytes{};
  ::randombytes_buf(bytes.data(), bytes.size());
  return as_text(bytes);
}

std::uint32_t random_below(std::uint32_t end) {
  need_library();
  return ::randombytes_uniform(end);
}

bool equal_secrets(std::string_view a, std::string_view b) {
  return a.size() == b.size() && ::sodium_memcmp(a.data(), b.data(), a.size()) == 0;
}

std::string token_hash(std::string_view token) {
  need_library();
  std::array<unsigned char, crypto_generichash_BYTES> hash{};
  ::crypto_generichash(hash.data(), hash.size(),
                       reinterpret_cast<const unsigned char*>(token.data()), token.size(), nullptr,
                       0);
  return as_text(hash);
}

}  // namespace orbwatch::app::web
