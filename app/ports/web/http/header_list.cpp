// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/header_list.h"

#include "app/ports/web/http/address.h"

namespace orbwatch::app::web {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

}  // namespace

std::optional<std::vector<std::string_view>> split(std::string_view text, char separator,
                                                   Quotes quotes) {
  std::vector<std::string_view> parts;
  std::size_t begin = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_quoted && text[i] == '\\') {
      ++i;
    } else if (text[i] == '"' && quotes == Quotes::Hold) {
      is_quoted = !is_quoted;
    } else if (text[i] == separator && !is_quoted) {
      parts.push_back(trimmed(text.substr(begin, i - begin)));
      begin = i + 1;
    }
  }
  if (is_quoted) return std::nullopt;
  parts.push_back(trimmed(text.substr(begin)));
  return parts;
}

std::optional<std::vector<std::string>> list_of(const Request& request, std::string_view name,
                                                Quotes quotes) {
  std::vector<std::string> list;
  for (const auto& [sent, value] : request.headers) {
    if (!equal_in_any_case(sent, name)) continue;
    const auto parts = split(value, ',', quotes);
    if (!parts) return std::nullopt;
    list.insert(list.end(), parts->begin(), parts->end());
  }
  return list;
}

std::vector<std::string> plain_list_of(const Request& request, std::string_view name) {
  return *list_of(request, name, Quotes::None);
}

}  // namespace orbwatch::app::web
