// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/forwarding.h"

#include <gmock/gmock.h>

namespace orbwatch::app::web {
namespace {

using testing::HasSubstr;

const std::vector<hal::Network> kTrusted =
    hal::parse_networks({"127.0.0.1", "10.1.0.0/16"}).value();

Request request_from(const std::string& peer, Values headers) {
  Request request;
  request.peer = peer;
  request.host = "board.example";
  request.headers = std::move(headers);
  return request;
}

/// A request from a trusted proxy, after its headers were applied.
Request forwarded(Values headers) {
  Request request = request_from("127.0.0.1", std::move(headers));
  const auto taken = take_forwarding(request, kTrusted);
  EXPECT_TRUE(taken) << taken.error().message;
  return request;
}

std::string client_of(Values headers) { return forwarded(std::move(headers)).peer; }

TEST(PassedOn, IsWhatAnyProxyHeaderIsIn) {
  for (const char* name : {"Forwarded", "forwarded", "X-Forwarded-For", "X-FORWARDED-HOST",
                           "X-Forwarded-Anything", "X-Real-IP", "Via"}) {
    EXPECT_TRUE(is_passed_on({{"Host", "a"}, {name, ""}})) << name;
  }
  EXPECT_FALSE(is_passed_on({{"Host", "a"}, {"X-Forwarded", "1"}, {"X-Real", "1"}}));
}

TEST(Forwarding, OfAProxyThatIsNotTrustedIsNotBelieved) {
  Request request = request_from("10.2.0.1", {{"X-Forwarded-For", "203.0.113.9"},
                                              {"X-Forwarded-Proto", "https"},
                                              {"X-Forwarded-Host", "evil.example"},
                                              {"X-Forwarded-Prefix", "/evil"}});
  ASSERT_TRUE(take_forwarding(request, kTrusted));
  EXPECT_EQ(request.passage, Passage::UntrustedProxy);
  EXPECT_EQ(request.peer, "10.2.0.1");
  EXPECT_EQ(request.host, "board.example");
  EXPECT_EQ(request.prefix, "");
  EXPECT_FALSE(request.is_secure);
  Request direct = request_from("10.2.0.1", {});
  ASSERT_TRUE(take_forwarding(direct, kTrusted));
  EXPECT_EQ(direct.passage, Passage::Direct);
}

TEST(Forwarding, SaysWhatTheClientAskedFor) {
  const Request request = forwarded({{"X-Forwarded-For", "203.0.113.9"},
                                     {"X-Forwarded-Proto", "https"},
                                     {"X-Forwarded-Host", "plant.example"},
                                     {"X-Forwarded-Prefix", "/cell4/orbwatch/"}});
  EXPECT_EQ(request.passage, Passage::TrustedProxy);
  EXPECT_EQ(request.peer, "203.0.113.9");
  EXPECT_TRUE(request.is_secure);
  EXPECT_EQ(request.host, "plant.example");
  EXPECT_EQ(request.prefix, "/cell4/orbwatch");
  const Request same =
      forwarded({{"Forwarded", R"(for="203.0.113.9:4711";proto=https;host="plant.example")"}});
  EXPECT_EQ(same.peer, "203.0.113.9");
  EXPECT_TRUE(same.is_secure);
  EXPECT_EQ(same.host, "plant.example");
}

TEST(Forwarding, OfATrustedProxyThatSaysNothingIsItsOwn) {
  const Request request = forwarded({});
  EXPECT_EQ(request.passage, Passage::TrustedProxy) << "this computer is not its client";
  EXPECT_EQ(request.peer, "127.0.0.1");
  EXPECT_EQ(request.host, "board.example");
  EXPECT_FALSE(request.is_secure);
}

TEST(Forwarding, BelievesTheLastAddressThatIsNotTrusted) {
  EXPECT_EQ(client_of({{"X-Forwarded-For", "198.51.100.1, 203.0.113.9"}}), "203.0.113.9")
      << "the client itself sent the first one";
  EXPECT_EQ(client_of({{"X-Forwarded-For", "198.51.100.1"}, {"X-Forwarded-For", "203.0.113.9"}}),
            "203.0.113.9");
  EXPECT_EQ(client_of({{"X-Forwarded-For", "203.0.113.9, 10.1.0.2, 10.1.0.3"}}), "203.0.113.9");
  EXPECT_EQ(client_of({{"X-Forwarded-For", "10.1.0.2"}}), "10.1.0.2") << "a proxy itself asked";
  EXPECT_EQ(client_of({{"Forwarded", "for=198.51.100.1, for=203.0.113.9, for=10.1.0.2"}}),
            "203.0.113.9");
  EXPECT_EQ(client_of({{"Forwarded", R"(for="[2001:db8::9]:1";by="a,b;for=127.0.0.1")"}}),
            "2001:db8::9");
}

TEST(Forwarding, StopsAtWhatIsNoAddress) {
  EXPECT_EQ(client_of({{"X-Forwarded-For", "203.0.113.9, unknown, 10.1.0.2"}}), "10.1.0.2");
  for (const char* node :
       {"unknown", "_hidden", "", "127.0.0.1.evil.example", "203.0.113.9:x", "[::1", "1"}) {
    EXPECT_EQ(client_of({{"X-Forwarded-For", node}}), "127.0.0.1") << node;
    EXPECT_EQ(client_of({{"Forwarded", std::string("for=") + node}}), "127.0.0.1") << node;
  }
}

TEST(Forwarding, WritesAddressesAsOthersAre) {
  EXPECT_EQ(client_of({{"X-Forwarded-For", "::ffff:203.0.113.9"}}), "203.0.113.9");
  EXPECT_EQ(client_of({{"X-Forwarded-For", "2001:DB8:0::9"}}), "2001:db8::9");
  EXPECT_EQ(client_of({{"X-Forwarded-For", "203.0.113.9:4711"}}), "203.0.113.9");
}

TEST(Forwarding, TakesWhatStandsBesideTheClient) {
  const Request request = forwarded({{"X-Forwarded-For", "203.0.113.9, 10.1.0.2"},
                                     {"X-Forwarded-Proto", "https, http"},
                                     {"X-Forwarded-Host", "evil.example, plant.example, inner"}});
  EXPECT_TRUE(request.is_secure);
  EXPECT_EQ(request.host, "plant.example");
  EXPECT_TRUE(
      forwarded({{"X-Forwarded-For", "203.0.113.9, 10.1.0.2"}, {"X-Forwarded-Proto", "https"}})
          .is_secure);
  EXPECT_FALSE(forwarded({{"X-Forwarded-For", "203.0.113.9"}, {"X-Forwarded-Proto", "https, http"}})
                   .is_secure)
      << "the client itself sent the first one";
}

TEST(Forwarding, ThatContradictsItselfIsRefused) {
  Request request = request_from(
      "127.0.0.1", {{"X-Forwarded-For", "203.0.113.9"}, {"Forwarded", "for=198.51.100.1"}});
  const auto taken = take_forwarding(request, kTrusted);
  ASSERT_FALSE(taken);
  EXPECT_THAT(taken.error().message, HasSubstr("different clients"));
  EXPECT_EQ(client_of({{"X-Forwarded-For", "203.0.113.9"}, {"Forwarded", "for=203.0.113.9"}}),
            "203.0.113.9");
}

/// A client's open quote must not hide the text that the proxy appends.
TEST(Forwarding, IsNotHiddenInAQuotedString) {
  Request request =
      request_from("127.0.0.1", {{"Forwarded", R"(for=198.51.100.1;by=", for=203.0.113.9)"}});
  EXPECT_FALSE(take_forwarding(request, kTrusted));
  EXPECT_EQ(client_of({{"X-Forwarded-For", R"(198.51.100.1, ", 203.0.113.9)"}}), "203.0.113.9");
}

TEST(Forwarding, NamesAPathOrNothing) {
  for (const char* prefix : {"cell4", "//evil.example", "/a;Domain=evil", "/a b", "/a/../b", "/..",
                             "/a\r\nX: y", "https://evil.example/"}) {
    Request request = request_from("127.0.0.1", {{"X-Forwarded-Prefix", prefix}});
    EXPECT_FALSE(take_forwarding(request, kTrusted)) << prefix;
  }
  EXPECT_EQ(forwarded({{"X-Forwarded-Prefix", "/"}}).prefix, "");
}

}  // namespace
}  // namespace orbwatch::app::web
