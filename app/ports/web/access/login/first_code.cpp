// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/login/first_code.h"

#include <algorithm>
#include <cctype>
#include <system_error>

#include "app/ports/web/access/login/secret.h"
#include "app/state/private_file.h"

namespace orbwatch::app::web {
namespace {

constexpr std::size_t kCharacters = 8, kGroup = 4;
/// Alphabet of Crockford's base 32.
constexpr std::string_view kAlphabet = "0123456789ABCDEFGHJKMNPQRSTVWXYZ";

std::filesystem::path code_file(const std::filesystem::path& folder) {
  return folder / "first-code";
}

/// Maps typed characters to those of kAlphabet.
std::string plain(std::string_view typed) {
  std::string plain;
  for (const char c : typed) {
    const char upper = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    if (upper == '-' || upper == ' ') continue;
    plain += upper == 'O' ? '0' : upper == 'I' || upper == 'L' ? '1' : upper;
  }
  return plain;
}

}  // namespace

std::string random_code() {
  std::string code;
  for (std::size_t i = 0; i < kCharacters; ++i) {
    if (i == kGroup) code += '-';
    code += kAlphabet[random_below(kAlphabet.size())];
  }
  return code;
}

bool is_code(std::string_view code, std::string_view typed) {
  return plain(code).size() == kCharacters && equal_secrets(plain(code), plain(typed));
}

Result<std::optional<std::string>> kept_code(const std::filesystem::path& folder) {
  return read_private(code_file(folder)).map([](std::optional<std::string> text) {
    if (text) *text = text->substr(0, text->find('\n'));
    return text;
  });
}

Result<std::string> keep_code(const std::filesystem::path& folder) {
  auto kept = kept_code(folder);
  if (!kept) return tl::unexpected(kept.error());
  if (*kept && plain(**kept).size() == kCharacters) return std::move(**kept);
  const std::string code = random_code();
  return write_private(code_file(folder), code + "\n").map([&] { return code; });
}

Result<> forget_code(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::remove(code_file(folder), error);
  if (!error) return {};
  return fail(code_file(folder).string() + ": cannot be removed: " + error.message());
}

}  // namespace orbwatch::app::web
