// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <utility>

#include "app/ports/web/page/page_files.h"

namespace orbwatch::app::web {

std::string_view page_type(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kTypes{
      {{".html", "text/html; charset=utf-8"},
       {".css", "text/css; charset=utf-8"},
       {".js", "text/javascript; charset=utf-8"},
       {".svg", "image/svg+xml"}}};
  for (const auto& [ending, type] : kTypes) {
    if (name.ends_with(ending)) return type;
  }
  return {};
}

}  // namespace orbwatch::app::web
