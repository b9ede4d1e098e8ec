// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/page/page_routes.h"

#include <string>
#include <utility>

#include "app/ports/web/http/fixed_content.h"
#include "app/ports/web/page/page_files.h"

namespace orbwatch::app::web {

std::vector<Route> page_routes() {
  std::vector<Route> routes;
  for (const PageFile& file : kPageFiles) {
    Route route{"GET", "/", Role::Nobody, "Of the page", std::string(page_type(file.name))};
    if (file.name != "index.html") route.path += file.name;
    route.is_page = true;
    route.serve = [content = FixedContent(route.type, file.content, file.packed)](
                      const ExchangePtr& exchange) { content.answer(exchange); };
    routes.push_back(route);
    if (file.name != "index.html") continue;
    route.path = "/operator";  // the same, which the page reads in its address
    routes.push_back(std::move(route));
  }
  return routes;
}

}  // namespace orbwatch::app::web
