// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/request_form.h"

#include <gmock/gmock.h>

namespace orbwatch::app::web {
namespace {

using testing::HasSubstr;

const ServerNames kOwn{{"board.example"}, {}};

Request request_to(const std::string& target, Values headers) {
  Request request;
  request.target = target;
  request.path = target.substr(0, target.find('?'));
  request.peer = "127.0.0.1";
  request.headers = std::move(headers);
  return request;
}

/// Status of a refusal; 0: served.
int refusal_of(Request request, const char* version = "HTTP/1.1") {
  const auto refusal = settle_form(request, version, kOwn);
  return refusal ? refusal->status : 0;
}

TEST(RequestForm, TakesTheHostOfAnAbsoluteTarget) {
  for (const char* base :
       {"http://board.example", "HTTP://BOARD.example", "https://board.example"}) {
    Request request =
        request_to(std::string(base) + "/metrics?a=http://x/", {{"Host", "evil.example"}});
    EXPECT_FALSE(settle_form(request, "HTTP/1.1", kOwn)) << base;
    EXPECT_EQ(request.path, "/metrics");
    EXPECT_EQ(request.target, "/metrics?a=http://x/");
    EXPECT_EQ(request.host, std::string(base).substr(std::string(base).find("//") + 2));
  }
  Request root = request_to("http://127.0.0.1:8080?a=b", {{"Host", "127.0.0.1:8080"}});
  EXPECT_FALSE(settle_form(root, "HTTP/1.1", kOwn));
  EXPECT_EQ(root.path, "/");
  EXPECT_EQ(root.target, "/?a=b");
  EXPECT_EQ(refusal_of(request_to("http://evil.example/", {{"Host", "board.example"}})), 421);
  EXPECT_EQ(refusal_of(request_to("http:///", {{"Host", "board.example"}})), 400);
  EXPECT_EQ(refusal_of(request_to("http://board.example@evil.example/", {{"Host", "x"}})), 421);
}

TEST(RequestForm, HasOneHost) {
  EXPECT_EQ(refusal_of(request_to("/", {{"Host", "board.example"}})), 0);
  EXPECT_EQ(refusal_of(request_to("/", {{"Host", "board.example."}})), 0);
  EXPECT_EQ(refusal_of(request_to("/", {{"Host", "board.example"}, {"host", "board.example"}})),
            400);
  EXPECT_EQ(refusal_of(request_to("/", {{"Host", "evil.example"}})), 421);
  for (const char* malformed : {"", ":80", "[::1", "board.example:x"}) {
    EXPECT_EQ(refusal_of(request_to("/", {{"Host", malformed}})), 400) << malformed;
  }
  EXPECT_EQ(refusal_of(request_to("/", {})), 400);
}

TEST(RequestForm, HasNamesOfHeadersThatAreTokens) {
  for (const char* name :
       {"Via ", "X-Real-IP\t", "Host ", "", "Content-Length ", "a:b", "\xc3\xa4"}) {
    EXPECT_EQ(refusal_of(request_to("/", {{"Host", "board.example"}, {name, "1"}})), 400) << name;
  }
  EXPECT_EQ(refusal_of(request_to("/", {{"Host", "board.example"}, {"x!#$%&'*+-.^_`|~9", "1"}})),
            0);
}

TEST(RequestForm, OfTheOldVersionNeedsNone) {
  EXPECT_EQ(refusal_of(request_to("/", {}), "HTTP/1.0"), 0);
  EXPECT_EQ(refusal_of(request_to("/", {{"Host", "evil.example"}}), "HTTP/1.0"), 421);
  EXPECT_EQ(refusal_of(request_to("/", {{"Host", ""}}), "HTTP/1.0"), 400);
}

TEST(RequestForm, HasOneEnd) {
  const auto status = [](Values lengths) {
    lengths.emplace_back("Host", "board.example");
    return refusal_of(request_to("/", std::move(lengths)));
  };
  EXPECT_EQ(status({{"Content-Length", "2"}}), 0);
  EXPECT_EQ(status({{"Transfer-Encoding", "chunked"}}), 0);
  EXPECT_EQ(status({{"Content-Length", "2"}, {"content-length", "2"}}), 400);
  EXPECT_EQ(status({{"Content-Length", "2"}, {"Transfer-Encoding", "chunked"}}), 400);
}

TEST(RequestForm, HasNoZeroByte) {
  EXPECT_EQ(refusal_of(request_to("/%00", {{"Host", "board.example"}})), 400);
}

TEST(RequestForm, FromATrustedProxyIsForAHostOfItsOwn) {
  const ServerNames own{{"board.example"}, hal::parse_networks({"127.0.0.1"}).value()};
  Request request = request_to("/", {{"Host", "upstream"}, {"X-Forwarded-Host", "board.example"}});
  EXPECT_FALSE(settle_form(request, "HTTP/1.1", own));
  Request other =
      request_to("/", {{"Host", "board.example"}, {"X-Forwarded-Host", "evil.example"}});
  EXPECT_EQ(settle_form(other, "HTTP/1.1", own)->status, 421);
  Request twice = request_to(
      "/",
      {{"Host", "board.example"}, {"Forwarded", "for=1.2.3.4"}, {"X-Forwarded-For", "5.6.7.8"}});
  EXPECT_THAT(*settle_form(twice, "HTTP/1.1", own)->body, HasSubstr("different clients"));
}

}  // namespace
}  // namespace orbwatch::app::web
