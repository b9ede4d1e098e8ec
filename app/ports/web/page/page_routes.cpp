// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/page/page_routes.h"

#include <memory>
#include <utility>

#include "app/ports/web/page/page_files.h"

namespace orbwatch::app::web {

std::vector<Route> page_routes() {
  std::vector<Route> routes;
  routes.reserve(kPageFiles.size());
  for (const PageFile& file : kPageFiles) {
    Route route{"GET", "/", Role::Nobody, "Of the page", std::string(page_type(file.name))};
    if (file.name != "index.html") route.path += file.name;
    route.is_page = true;
    route.serve = [type = route.type, content = std::make_shared<const std::string>(file.content)](
                      const ExchangePtr& exchange) {
      exchange->answer(body_response(type, content));
    };
    routes.push_back(std::move(route));
  }
  return routes;
}

}  // namespace orbwatch::app::web
