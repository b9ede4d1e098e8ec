// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/content_coding.h"

#include <gmock/gmock.h>

#include <random>
#include <utility>

#include "tests/app/ports/web/gunzip.h"
#include "tests/app/ports/web/served.h"

namespace orbwatch::app::web::tests {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::StartsWith;

TEST(Gzip, KeepsWhatItCompresses) {
  std::string noise(100'000, '\0');
  std::mt19937 random(1);
  for (char& byte : noise) byte = static_cast<char>(random());
  for (const std::string& content :
       {std::string(), std::string("a"), std::string(500'000, 'a'), noise}) {
    for (const int level : {1, 9}) {
      EXPECT_EQ(gunzip(gzip(content, level)), content) << content.size();
    }
  }
  EXPECT_LT(gzip(std::string(500'000, 'a')).size(), 1000U);
}

const Values kVary{{"Vary", "Accept-Encoding"}};
const Values kPacked{{"Vary", "Accept-Encoding"}, {"Content-Encoding", "gzip"}};

Request request_that_accepts(const std::string& codings) {
  Request request;
  request.headers = {{"Accept-Encoding", codings}};
  return request;
}

TEST(PackedAnswer, HasTheContentOfAJsonAnswer) {
  const std::string text(kLeastPacked, 'x');
  const Response packed = packed_for(request_that_accepts("gzip"), body_response(kJson, text, 409));
  EXPECT_EQ(packed.headers, kPacked);
  EXPECT_EQ(packed.status, 409);
  EXPECT_EQ(gunzip(*packed.body), text);
}

TEST(PackedAnswer, IsNotForClientsThatDoNotAcceptIt) {
  const std::string text(kLeastPacked, 'x');
  for (const char* codings : {"", "br", "gzip;q=0"}) {
    const Response answer = packed_for(request_that_accepts(codings), body_response(kJson, text));
    EXPECT_EQ(answer.headers, kVary) << codings;
    EXPECT_EQ(*answer.body, text);
  }
}

TEST(PackedAnswer, IsNeitherSmallNorAPictureNorCodedTwice) {
  const std::string text(kLeastPacked, 'x');
  Response coded = body_response(kJson, text);
  coded.headers = kPacked;
  Response unchanged = body_response(kJson, text);
  unchanged.body = nullptr;
  for (const auto& [response, headers] :
       {std::pair{body_response(kJson, text.substr(1)), Values()},
        std::pair{body_response(kJpeg, text), Values()}, std::pair{coded, kPacked},
        std::pair{unchanged, Values()}}) {
    const Response answer = packed_for(request_that_accepts("gzip"), response);
    EXPECT_EQ(answer.headers, headers);
    EXPECT_EQ(answer.body, response.body);
  }
}

TEST_F(Served, TheStatusIsPacked) {
  start();
  const Answer plain = get(port(), "/api/v1/status");
  const Answer packed = get(port(), "/api/v1/status", "Accept-Encoding: gzip\r\n");
  ASSERT_GE(plain.body.size(), kLeastPacked);
  EXPECT_EQ(plain.headers.count("Content-Encoding"), 0U);
  EXPECT_EQ(packed.headers.at("Content-Encoding"), "gzip");
  EXPECT_LT(packed.body.size(), plain.body.size());
  EXPECT_THAT(gunzip(packed.body), AllOf(StartsWith("{"), EndsWith("}\n")));
}

}  // namespace
}  // namespace orbwatch::app::web::tests
