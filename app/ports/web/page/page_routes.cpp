// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/page/page_routes.h"

#include <memory>
#include <string>
#include <utility>

#include "app/ports/web/http/accepted_encoding.h"
#include "app/ports/web/http/entity_tag.h"
#include "app/ports/web/page/page_files.h"

namespace orbwatch::app::web {
namespace {

/// A file that is sent compressed to clients that accept this.
class ServedFile {
 public:
  explicit ServedFile(const PageFile& file)
      : content_(std::make_shared<const std::string>(file.content)),
        packed_(std::make_shared<const std::string>(file.packed)),
        type_(page_type(file.name)),
        tag_(entity_tag(file.content)) {}

  void operator()(const ExchangePtr& exchange) const {
    const bool is_packed = accepts_gzip(exchange->request());
    Response response = body_response(type_, is_packed ? packed_ : content_);
    response.tag = tag_;
    response.headers.emplace_back("Vary", "Accept-Encoding");
    if (is_packed) response.headers.emplace_back("Content-Encoding", "gzip");
    exchange->answer(std::move(response));
  }

 private:
  Bytes content_, packed_;
  std::string type_, tag_;
};

}  // namespace

std::vector<Route> page_routes() {
  std::vector<Route> routes;
  routes.reserve(kPageFiles.size());
  for (const PageFile& file : kPageFiles) {
    Route route{"GET", "/", Role::Nobody, "Of the page", std::string(page_type(file.name))};
    if (file.name != "index.html") route.path += file.name;
    route.is_page = true;
    route.serve = ServedFile(file);
    routes.push_back(std::move(route));
  }
  return routes;
}

}  // namespace orbwatch::app::web
