// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace orbwatch::app::web {

/// SHA-256 of bytes that arrive in parts; at first of none. Thread-bound.
class Sha256 {
 public:
  Sha256();
  ~Sha256();

  /// Forgets the bytes so far.
  void restart();
  void add(std::string_view bytes);
  /// Hash of the bytes so far in lower-case hexadecimal digits, as sha256sum prints it.
  std::string digits() const;

 private:
  struct State;  // keeps libsodium out of the header

  std::unique_ptr<State> state_;
};

}  // namespace orbwatch::app::web
