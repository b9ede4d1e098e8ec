// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/accepted_encoding.h"

#include <gtest/gtest.h>

namespace orbwatch::app::web {
namespace {

/// Result for a request with these lines of Accept-Encoding.
bool gzip_after(const std::vector<std::string>& lines) {
  Request request;
  request.headers = {{"Host", "127.0.0.1"}};
  for (const std::string& line : lines) request.headers.emplace_back("accept-encoding", line);
  return accepts_gzip(request);
}

TEST(AcceptedEncoding, IsGzipWhereItIsListed) {
  for (const char* line :
       {"gzip", "GZip", "x-gzip", "gzip, deflate, br, zstd", "br,gzip", "br;q=1.0 , gzip;q=0.001",
        "gzip ; q=0.5", "gzip;Q=1.000", "br,, gzip"}) {
    EXPECT_TRUE(gzip_after({line})) << line;
  }
  EXPECT_TRUE(gzip_after({"br", "gzip;q=0.2"}));
}

TEST(AcceptedEncoding, IsNoneWithoutTheHeaderOrWithAnEmptyOne) {
  EXPECT_FALSE(gzip_after({}));
  EXPECT_FALSE(gzip_after({""}));
}

TEST(AcceptedEncoding, IsNotWhatHasTheWeightZero) {
  for (const char* line : {"gzip;q=0", "gzip;q=0.000", "x-gzip;q=0, br", "gzip;q=0, *", "br",
                           "identity", "deflate, identity", "gzipped"}) {
    EXPECT_FALSE(gzip_after({line})) << line;
  }
}

TEST(AcceptedEncoding, OfAWildcardIsThatOfCodingsThatAreNotListed) {
  EXPECT_TRUE(gzip_after({"*"}));
  EXPECT_TRUE(gzip_after({"br;q=1, *;q=0.1"}));
  EXPECT_TRUE(gzip_after({"gzip, *;q=0"}));
  EXPECT_TRUE(gzip_after({"identity;q=0, *"}));
  EXPECT_FALSE(gzip_after({"*;q=0"}));
  EXPECT_FALSE(gzip_after({"identity, *;q=0"}));
}

TEST(AcceptedEncoding, IsNotGzipWhereIdentityIsPreferred) {
  EXPECT_FALSE(gzip_after({"gzip;q=0.5, identity"}));
  EXPECT_FALSE(gzip_after({"identity;q=0.6, *;q=0.5"}));
  EXPECT_TRUE(gzip_after({"gzip;q=0.5, identity;q=0.5"}));
  EXPECT_TRUE(gzip_after({"gzip;q=0.5, identity;q=0"}));
}

TEST(AcceptedEncoding, IsNotWhatIsMalformed) {
  for (const char* line : {"gzip;q=", "gzip;q=x", "gzip;q=2", "gzip;q=-1", "gzip;q=nan",
                           "gzip;q=inf", "gzip;q=1;q=1", "gzip;level=9", "gzip;", "gzip q=1"}) {
    EXPECT_FALSE(gzip_after({line})) << line;
  }
}

}  // namespace
}  // namespace orbwatch::app::web
