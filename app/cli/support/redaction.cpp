// SPDX-License-Identifier: Apache-2.0
#include "app/cli/support/redaction.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "app/cli/support/secret_value.h"

namespace orbwatch::app::cli::support {
namespace {

constexpr std::size_t kFirstCode = 9;  ///< characters of the code for the first password
constexpr std::string_view kEndOfWord = " \t\r\n\"'<>,;&)";

/// Parts of names; matched in lower case.
constexpr std::array<std::string_view, 14> kSecretNames{
    "password", "passwd",      "passphrase", "passwort",    "secret", "token",         "api_key",
    "apikey",   "private_key", "privatekey", "private-key", "psk",    "authorization", "cookie"};

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

std::string in_lower_case(std::string_view text) {
  std::string copy(text);
  std::ranges::transform(copy, copy.begin(), lower);
  return copy;
}

std::string replaced(std::string_view text, const std::string& part) {
  std::string out;
  for (std::size_t at = 0;;) {
    const std::size_t found = text.find(part, at);
    out += text.substr(at, found - at);
    if (found == std::string_view::npos) return out;
    out += kRemoved;
    at = found + part.size();
  }
}

/// Copies the text without the spans that `next(text, from)` finds, the first at or after `from`.
template <class Next>
std::string without(std::string_view text, const Next& next) {
  std::string out;
  for (std::size_t at = 0;;) {
    const Span span = next(text, at);
    if (span.end <= span.begin) return out.append(text.substr(at));
    out.append(text.substr(at, span.begin - at)).append(kRemoved);
    at = span.end;
  }
}

/// A private key in PEM, up to its last line or, if it has none, the end of the text.
Span private_key(std::string_view text, std::size_t from) {
  constexpr std::string_view kBegin = "-----BEGIN ", kKey = "PRIVATE KEY-----", kEnd = "-----END ";
  for (std::size_t at = text.find(kBegin, from); at != text.npos; at = text.find(kBegin, at + 1)) {
    const std::size_t line = std::min(text.find('\n', at), text.size());
    if (text.substr(at, line - at).find(kKey) == text.npos) continue;
    const std::size_t end = text.find(kEnd, at);
    const std::size_t last = end == text.npos ? end : text.find(kKey, end);
    return {at, last == text.npos ? text.size() : last + kKey.size()};
  }
  return {};
}

/// User and password between "//" and "@".
Span user_of_address(std::string_view text, std::size_t from) {
  constexpr std::string_view kScheme = "://";
  for (std::size_t at = text.find(kScheme, from); at != text.npos;
       at = text.find(kScheme, at + 1)) {
    const std::size_t begin = at + kScheme.size();
    const std::size_t end = std::min(text.find_first_of(" \t\r\n\"'<>/", begin), text.size());
    const std::size_t user = text.substr(begin, end - begin).rfind('@');
    if (user != text.npos && user > 0) return {begin, begin + user};
  }
  return {};
}

/// The word after `before`, or both.
Span word_after(std::string_view text, std::size_t from, std::string_view before, bool both) {
  for (std::size_t at = text.find(before, from); at != text.npos; at = text.find(before, at + 1)) {
    const std::size_t begin = at + before.size();
    const std::size_t end = std::min(text.find_first_of(kEndOfWord, begin), text.size());
    if (end > begin) return {both ? at : begin, end};
  }
  return {};
}

/// Eight letters and digits as "K7QX-2M9P".
bool is_first_code(std::string_view word) {
  constexpr std::size_t kDash = 4;
  if (word.size() < kFirstCode || word[kDash] != '-') return false;
  if (word.size() > kFirstCode && is_name_character(word[kFirstCode])) return false;
  for (std::size_t i = 0; i < kFirstCode; ++i) {
    const auto c = static_cast<unsigned char>(word[i]);
    if (i != kDash && std::isdigit(c) == 0 && std::isupper(c) == 0) return false;
  }
  return true;
}

/// The code for the first password soon after "code", as the log has it.
Span first_code(std::string_view text, std::size_t from) {
  constexpr std::string_view kCode = "code";
  constexpr std::size_t kNear = 80;
  for (std::size_t at = text.find(kCode, from); at != text.npos; at = text.find(kCode, at + 1)) {
    const std::size_t line = std::min({text.find('\n', at), text.size(), at + kNear});
    for (std::size_t word = at + kCode.size(); word < line; ++word) {
      const bool begins = !is_name_character(text[word - 1]);
      if (begins && is_first_code(text.substr(word))) return {word, word + kFirstCode};
    }
  }
  return {};
}

/// The value after a secret name.
Span named_value(std::string_view text, std::string_view in_lower, std::size_t from) {
  for (std::size_t at = from; at < text.size(); ++at) {
    const std::string_view rest = in_lower.substr(at);
    const auto begins = [&](std::string_view name) { return rest.starts_with(name); };
    if (std::ranges::none_of(kSecretNames, begins)) continue;
    const Span value = secret_value(text, at);
    if (value.end > value.begin) return value;
  }
  return {};
}

std::string without_named_values(std::string_view text) {
  const std::string in_lower = in_lower_case(text);
  return without(text, [&](std::string_view all, std::size_t from) {
    return named_value(all, in_lower, from);
  });
}

}  // namespace

bool is_secret_name(std::string_view name) {
  const std::string in_lower = in_lower_case(name);
  return std::ranges::any_of(kSecretNames, [&](std::string_view part) {
    return in_lower.find(part) != std::string::npos;
  });
}

Redaction::Redaction(std::vector<std::string> secrets) : secrets_(std::move(secrets)) {
  std::erase_if(secrets_, [](const auto& secret) { return secret.size() < kShortestSecret; });
  std::ranges::sort(secrets_, [](const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() > b.size() : a < b;
  });
  secrets_.erase(std::unique(secrets_.begin(), secrets_.end()), secrets_.end());
}

std::string Redaction::operator()(std::string_view text) const {
  std::string out(text);
  for (const std::string& secret : secrets_) out = replaced(out, secret);
  out = without(out, private_key);
  out = without_named_values(out);
  out = without(out, user_of_address);
  out = without(out, first_code);
  const auto hash = [](std::string_view all, std::size_t from) {
    return word_after(all, from, "$argon2", true);
  };
  out = without(out, hash);
  for (const std::string_view scheme : {"Bearer ", "Basic "}) {
    out = without(out, [scheme](std::string_view all, std::size_t from) {
      return word_after(all, from, scheme, false);
    });
  }
  return out;
}

}  // namespace orbwatch::app::cli::support
