// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace orbwatch::app::cli::support {

/// Text in place of a secret.
inline constexpr std::string_view kRemoved = "[removed]";

/// True for the name of a value that is secret, such as api_token or ADMIN_PASSWORD. Reentrant.
bool is_secret_name(std::string_view name);

/// Removes secrets from texts for other people. Reentrant.
class Redaction {
 public:
  /// `secrets`: values that are removed wherever they occur; those below kShortestSecret are not,
  /// because they would occur by chance.
  explicit Redaction(std::vector<std::string> secrets);

  static constexpr std::size_t kShortestSecret = 6;

  /// The text without the secrets, private keys in PEM, values of secret names ("password = ...",
  /// "token": ..., <Password>...</Password>, --token ...), users in addresses (//user:password@),
  /// hashes of passwords, HTTP credentials and codes for the first password. It may remove more.
  std::string operator()(std::string_view text) const;

 private:
  std::vector<std::string> secrets_;  ///< longest first
};

}  // namespace orbwatch::app::cli::support
