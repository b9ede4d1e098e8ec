// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "proc/image/result.h"

/// SHA-256 (FIPS 180-4) by libsodium, in lower-case hexadecimal digits as sha256sum prints them.
namespace orbwatch::app {

/// Hash of bytes that arrive in parts; at first of none. Thread-bound.
class Sha256 {
 public:
  Sha256();
  ~Sha256();

  /// Forgets the bytes so far.
  void restart();
  void add(std::string_view bytes);
  /// Hash of the bytes so far; more may follow.
  std::string digits() const;

 private:
  struct State;  // keeps libsodium out of the header

  std::unique_ptr<State> state_;
};

/// Hash of these bytes. Reentrant.
std::string sha256(std::string_view bytes);

/// Hash of a file's content, read in parts. Error: it cannot be read. Reentrant.
Result<std::string> sha256_of(const std::filesystem::path& file);

}  // namespace orbwatch::app
