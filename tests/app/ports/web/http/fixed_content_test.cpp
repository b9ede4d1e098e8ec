// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/fixed_content.h"

#include "tests/app/ports/web/gunzip.h"
#include "tests/app/ports/web/served.h"

namespace orbwatch::app::web::tests {
namespace {

/// The largest answer of a page's first load.
TEST_F(Served, TheDescriptionIsSentPackedAndOnlyOnce) {
  start();
  const Answer plain = get(port(), "/api/v1/openapi.json");
  const Answer packed = get(port(), "/api/v1/openapi.json", "Accept-Encoding: gzip\r\n");
  EXPECT_EQ(packed.headers.at("Content-Encoding"), "gzip");
  EXPECT_EQ(packed.headers.at("Content-Type"), "application/json");
  EXPECT_EQ(packed.headers.at("Vary"), "Accept-Encoding");
  EXPECT_EQ(gunzip(packed.body), plain.body);
  EXPECT_LT(packed.body.size(), plain.body.size() / 5);
  EXPECT_EQ(
      get(port(), "/api/v1/openapi.json", "If-None-Match: " + packed.headers.at("ETag") + "\r\n")
          .status,
      304);
}

}  // namespace
}  // namespace orbwatch::app::web::tests
