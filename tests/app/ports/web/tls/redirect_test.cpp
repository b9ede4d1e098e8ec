// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/tls/redirect.h"

#include <gmock/gmock.h>

namespace orbwatch::app::web {
namespace {

using testing::HasSubstr;

Response redirected(const std::string& host, const std::string& target, int port = 8443) {
  Request request;
  request.method = "GET";
  request.target = target;
  request.host = host;
  return to_https(request, port);
}

std::string location(const Response& response) {
  for (const auto& [name, value] : response.headers) {
    if (name == "Location") return value;
  }
  return "";
}

TEST(ToHttps, IsTheSamePlace) {
  EXPECT_EQ(location(redirected("ball.example:8080", "/snapshot.jpg?view=front&x=%20")),
            "https://ball.example:8443/snapshot.jpg?view=front&x=%20");
  EXPECT_EQ(location(redirected("10.0.0.7", "/", 443)), "https://10.0.0.7/");
  EXPECT_EQ(location(redirected("[fd00::1]:80", "/metrics")), "https://[fd00::1]:8443/metrics");
}

TEST(ToHttps, NeverLeavesTheHost) {
  for (const char* target : {"http://evil.example/", "//evil.example/", "/\r\nSet-Cookie: a=b",
                             "@evil.example", "*", "/a b", ""}) {
    const std::string place = location(redirected("10.0.0.7", target));
    EXPECT_TRUE(place.starts_with("https://10.0.0.7:8443/")) << place;
    EXPECT_EQ(place.find_first_of("\r\n "), std::string::npos) << place;
  }
  for (const char* host : {"", "[", "a:b", "a:80:80", ":80"}) {
    EXPECT_EQ(redirected(host, "/").status, 400) << host;
  }
}

TEST(ToHttps, RefusesWhatWouldChangeSomething) {
  Request request;
  request.method = "POST";
  request.target = "/api/v1/login";
  request.host = "10.0.0.7";
  const Response response = to_https(request, 8443);
  EXPECT_EQ(response.status, 403);
  EXPECT_THAT(*response.body, HasSubstr("https://10.0.0.7:8443/api/v1/login"));
  EXPECT_EQ(location(response), "");
}

TEST(StrictTransport, IsForOwnCertificatesOnTheUsualPorts) {
  WebSettings settings;
  settings.port = 80;
  settings.https_port = 443;
  EXPECT_TRUE(https_headers(settings).empty()) << "nobody could get past a self-made one";
  settings.certificate = "own.pem";
  ASSERT_EQ(https_headers(settings).size(), 1U);
  EXPECT_EQ(https_headers(settings).front().first, "Strict-Transport-Security");
  settings.port = 8080;
  EXPECT_TRUE(https_headers(settings).empty()) << "browsers would ask port 8080 for HTTPS";
}

}  // namespace
}  // namespace orbwatch::app::web
